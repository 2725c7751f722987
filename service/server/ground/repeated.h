// Something that is done again and again, on a thread of its own.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace albtpu::server {

class Repeated {
 public:
  // Calls `work` each time that `interval` has passed since it last returned.
  Repeated(std::chrono::milliseconds interval, std::function<void()> work);

  // Waits for `work` if it runs; it does not run thereafter.
  ~Repeated();

  Repeated(const Repeated&) = delete;
  Repeated& operator=(const Repeated&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable stopped_;
  bool stop_ = false;  // Guarded by mutex_.
  std::thread thread_;
};

}  // namespace albtpu::server
