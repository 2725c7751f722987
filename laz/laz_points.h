// The points of a LAZ file, from its beginning to its end, decoded ahead on all cores.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "laz/chunk_table.h"
#include "laz/coding/arithmetic_decoder.h"
#include "laz/items/chunk_decoder.h"
#include "laz/items/laszip_record.h"

namespace albtpu::laz {

// Batches of records that threads fill ahead, and one reader takes in order.

// Batch b lies in slot b mod `slots`, which is free once batch b - `slots` was taken. Threads that fill the batches of
// one chunk each, the chunks begun in order, never wait for each other in vain: the batch that the reader needs next
// always has its slot.
class BatchRing {
 public:
  struct Batch {
    std::vector<char> records;
    absl::Status status;  // Not OK: reading ends here.
  };

  explicit BatchRing(std::size_t slots) : slots_(slots) {}

  // For threads: waits for the slot of a batch; null when the ring is closed. The batch is the caller's until Fill().
  Batch* Wait(std::uint64_t batch) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return closed_ || batch < taken_ + slots_.size(); });
    return closed_ ? nullptr : &slots_[batch % slots_.size()].batch;
  }
  void Fill(std::uint64_t batch) {
    const std::lock_guard lock(mutex_);
    slots_[batch % slots_.size()].filled = true;
    changed_.notify_all();
  }

  // For the reader: waits for the next batch, which is the caller's until Release().
  Batch& Next() {
    std::unique_lock lock(mutex_);
    Slot& slot = slots_[taken_ % slots_.size()];
    changed_.wait(lock, [&] { return slot.filled; });
    return slot.batch;
  }
  void Release() {
    const std::lock_guard lock(mutex_);
    slots_[taken_++ % slots_.size()].filled = false;
    changed_.notify_all();
  }

  // Ends the waiting of all threads.
  void Close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

 private:
  struct Slot {
    Batch batch;
    bool filled = false;
  };

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Slot> slots_;
  std::uint64_t taken_ = 0;  // Batches that were released.
  bool closed_ = false;
};

// The place of the points in a file, and their compression.
struct LazExtent {
  LaszipRecord record;
  std::uint64_t points_begin = 0;  // The header's offset to the points.
  std::uint64_t point_count = 0;
  std::uint64_t points_end = 0;  // Upper bound of the end: the begin of EVLRs, or the end of the file.
};

class LazPoints {
 public:
  // `file` must outlive it. Decodes in `threads` threads of its own, fewer for records of several kB; 0: as many as
  // there are cores, at most 16. A file without chunk table is decoded in one. Fails when the chunk table contradicts
  // the file, or when there is none and the header does not count all points.
  //
  // The records have all fields, or at least those that are `wanted` (chunk_decoder.h).
  //
  // Memory does not grow with the file or its chunks: each thread has at most two batches of at most 50 000 points or
  // about 4 MB ahead of Read(). The models of all threads take less than 400 MB, whatever the records are.
  static absl::StatusOr<std::unique_ptr<LazPoints>> Open(const ByteSource& file, const LazExtent& extent,
                                                         int threads = 0, WantedFields wanted = WantedFields::kAll);
  ~LazPoints();  // At any time; ends the threads.

  // The first point, which is not compressed. Requires that there is one. Checks the chunk table alone.
  static absl::StatusOr<std::string> First(const ByteSource& file, const LazExtent& extent);

  // The next points: as many as fit. Requires a multiple of the record length, and no more points than are left. The
  // first failure in the order of the file ends the reading. The messages name the chunk.
  absl::Status Read(std::span<char> records);

  // The compressed chunk that has `count` points from number `first` on, and no others. Empty if the file has no such
  // chunk, or no chunk table. Any number of threads may call it at a time.
  absl::StatusOr<std::string> ReadChunk(std::uint64_t first, std::uint64_t count) const;

  // The end of the points and their chunk table. For a file without table it is known once all points are read.
  std::uint64_t end() const;

  // The end of what follows them: of the file, but for the offset of the chunk table that files which were written to a
  // pipe have there.
  std::uint64_t tail_end() const;

 private:
  class Impl;
  explicit LazPoints(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace albtpu::laz
