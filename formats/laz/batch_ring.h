// Batches of records that threads fill ahead, and one reader takes in order.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "absl/status/status.h"

namespace albtpu::laz {

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

}  // namespace albtpu::laz
