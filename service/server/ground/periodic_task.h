// A task that runs at intervals on its own thread.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace albtpu::server {

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

}  // namespace albtpu::server
