// The threads that handle long requests, one for each core. The threads of gRPC, which receive and send, never wait
// for them: the operating system shares the cores between both, so short requests are answered promptly under any load
// of long ones.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstddef>

#include "service/server/ground/limits.h"

namespace albtpu::server {

class Workers {
 public:
  // Takes one of the kMaxBulkCalls places for calls that may wait for workers. Returns false if none is free.
  bool Admit() {
    if (calls_.fetch_add(1) < kMaxBulkCalls) return true;
    Release();
    return false;
  }
  void Release() { calls_.fetch_sub(1); }

  // Runs `task` as soon as a worker is free; tasks start in the order of these calls. While a task waits for parts
  // of itself on other workers, its thread starts no other task.
  template <typename Task>
  void Run(Task task) {
    arena_.enqueue([task] { tbb::this_task_arena::isolate(task); });
  }

 private:
  // One more than there are cores: TBB reserves one place for the calling thread, which does not work here.
  tbb::global_control threads_{tbb::global_control::max_allowed_parallelism,
                               static_cast<std::size_t>(tbb::info::default_concurrency()) + 1};
  tbb::task_arena arena_{tbb::info::default_concurrency(), 0};
  std::atomic<int> calls_ = 0;
};

}  // namespace albtpu::server
