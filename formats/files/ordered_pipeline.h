// A file processed in chunks: chunks are read in order, worked on in parallel and written in order.
#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace albtpu::formats {

inline constexpr int kMaxWorkers = 16;

// Runs to the end of the file or to the first failure, and returns the failure that comes first in the file. Memory
// does not grow with the file: a few chunks, made by `make_chunk()`, are used again and again.
//   absl::StatusOr<bool> read(Chunk&)   in order; false at the end of the file
//   absl::Status work(Chunk&)           in parallel
//   absl::Status write(Chunk&)          in order; not called after a failure
template <typename MakeChunk, typename Read, typename Work, typename Write>
absl::Status RunOrderedPipeline(MakeChunk make_chunk, Read read, Work work, Write write) {
  using Chunk = decltype(make_chunk());
  struct Slot {
    Chunk chunk;
    absl::Status status;
  };
  // One thread more than cores, because some of them wait for the disk or a server; a limited number, because they all
  // share one disk and each has a chunk in memory.
  const int threads = std::min(oneapi::tbb::info::default_concurrency(), kMaxWorkers) + 1;
  std::vector<Slot> slots;
  for (int i = 0; i < threads; ++i) slots.push_back({make_chunk(), absl::OkStatus()});
  std::size_t next = 0;
  bool read_all = false;
  absl::Status result;
  std::atomic<bool> failed = false;
  // Reads the next chunk; null at the end.
  const auto read_next = [&]() -> Slot* {
    if (read_all) return nullptr;
    // Slots are released in order, so the next one in the ring is free.
    Slot& slot = slots[next++ % slots.size()];
    const absl::StatusOr<bool> more = read(slot.chunk);
    slot.status = more.status();
    read_all = !more.ok() || !*more;
    return !more.ok() || *more ? &slot : nullptr;
  };
  // Starting threads takes as long as the work on a small file, which one chunk holds.
  std::array<Slot*, 2> first = {read_next(), read_next()};
  if (first[1] == nullptr) {
    if (first[0] == nullptr) return absl::OkStatus();
    absl::Status status = first[0]->status;
    if (status.ok()) status = work(first[0]->chunk);
    return status.ok() ? write(first[0]->chunk) : status;
  }
  std::size_t taken = 0;  // Of `first`.
  const auto read_slot = [&](oneapi::tbb::flow_control& flow) -> Slot* {
    Slot* const slot = taken < first.size() ? first[taken++] : failed ? nullptr : read_next();
    if (slot == nullptr) flow.stop();
    return slot;
  };
  const auto work_on_slot = [&](Slot* slot) {
    if (slot->status.ok() && !failed) slot->status = work(slot->chunk);
    return slot;
  };
  const auto write_slot = [&](Slot* slot) {
    if (failed) return;
    if (slot->status.ok()) slot->status = write(slot->chunk);
    if (slot->status.ok()) return;
    result = slot->status;
    failed = true;
  };
  using oneapi::tbb::filter_mode;
  using oneapi::tbb::make_filter;
  const oneapi::tbb::global_control thread_count(oneapi::tbb::global_control::max_allowed_parallelism,
                                                 static_cast<std::size_t>(threads));
  oneapi::tbb::task_arena arena(threads);
  arena.execute([&] {
    oneapi::tbb::parallel_pipeline(slots.size(),
                                   make_filter<void, Slot*>(filter_mode::serial_in_order, read_slot) &
                                       make_filter<Slot*, Slot*>(filter_mode::parallel, work_on_slot) &
                                       make_filter<Slot*, void>(filter_mode::serial_in_order, write_slot));
  });
  return result;
}

}  // namespace albtpu::formats
