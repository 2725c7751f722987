// The threads of the server: tasks at intervals, the watch for inactivity, and the workers that handle long requests.
#pragma once

#include <grpcpp/alarm.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "service/server/ground/limits.h"

namespace albtpu::server {

// A task that runs at intervals on its own thread.
class PeriodicTask {
 public:
  // Calls `work` whenever `interval` has passed since the last call returned.
  PeriodicTask(std::chrono::milliseconds interval, std::function<void()> work);

  // Waits for a running `work` to return; it is not called after that.
  ~PeriodicTask();

  PeriodicTask(const PeriodicTask&) = delete;
  PeriodicTask& operator=(const PeriodicTask&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable stopped_;
  bool stop_ = false;  // Guarded by mutex_.
  std::thread thread_;
};

// Notices that there has been no activity for a while.

class IdleWatch {
 public:
  // Calls `on_idle` once, from a thread of gRPC, when NoteActivity() has not been called for a time between `limit`
  // and twice `limit`.
  IdleWatch(std::chrono::milliseconds limit, std::function<void()> on_idle);

  // Waits for a running `on_idle` to return; it is not called after that.
  ~IdleWatch();

  IdleWatch(const IdleWatch&) = delete;
  IdleWatch& operator=(const IdleWatch&) = delete;

  void NoteActivity();

  // Between Pause() and Resume(), which is activity, nothing is noticed.
  void Pause();
  void Resume();

 private:
  struct State;
  static void SetAlarm(const std::shared_ptr<State>& state);

  std::shared_ptr<State> state_;
};

// The threads that handle long requests, one for each core. The threads of gRPC, which receive and send, never wait
// for them: the operating system shares the cores between both, so short requests are answered promptly under any load
// of long ones.

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
