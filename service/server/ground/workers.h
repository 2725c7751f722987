// The threads that answer long requests, one a core. Those of gRPC, which receive and send, never wait for
// them: the system shares the cores between both, so that short requests are answered within moments under
// any load of long ones.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstddef>

#include "service/server/ground/limits.h"

namespace albtpu::server {

class Workers {
 public:
  // Place for one call among the kMaxBulkCalls that may wait for workers. False: there is none.
  bool Admit() {
    if (calls_.fetch_add(1) < kMaxBulkCalls) return true;
    Dismiss();
    return false;
  }
  void Dismiss() { calls_.fetch_sub(1); }

  // Runs `task` once a worker is free, in the order of the calls. While it waits for parts of itself on other
  // workers, its thread starts no other task.
  template <typename Task>
  void Run(Task task) {
    arena_.enqueue([task] { tbb::this_task_arena::isolate(task); });
  }

 private:
  // TBB counts a thread of ours among its own, and there is none here.
  tbb::global_control threads_{tbb::global_control::max_allowed_parallelism,
                               static_cast<std::size_t>(tbb::info::default_concurrency()) + 1};
  tbb::task_arena arena_{tbb::info::default_concurrency(), 0};
  std::atomic<int> calls_ = 0;
};

}  // namespace albtpu::server
