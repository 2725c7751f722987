#include "service/server/ground/periodic_task.h"

#include <utility>

namespace albtpu::server {

PeriodicTask::PeriodicTask(std::chrono::milliseconds interval, std::function<void()> work)
    : thread_([this, interval, work = std::move(work)] {
        std::unique_lock lock(mutex_);
        while (!stopped_.wait_for(lock, interval, [this] { return stop_; })) {
          lock.unlock();
          work();
          lock.lock();
        }
      }) {}

PeriodicTask::~PeriodicTask() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  stopped_.notify_one();
  thread_.join();
}

}  // namespace albtpu::server
