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

// Outlives the watch while its alarm is set.
struct IdleWatch::State {
  const std::chrono::milliseconds limit;
  std::function<void()> on_idle;
  std::atomic<bool> active = true;  // Since the alarm was last set.
  std::atomic<bool> paused = false;
  std::recursive_mutex mutex{};             // Recursive: `on_idle` may destroy the watch.
  bool ended = false;                       // Guarded by mutex.
  std::unique_ptr<grpc::Alarm> alarm = {};  // Guarded by mutex. A new one each time.
};

IdleWatch::IdleWatch(std::chrono::milliseconds limit, std::function<void()> on_idle)
    : state_(new State{.limit = limit, .on_idle = std::move(on_idle)}) {
  SetAlarm(state_);
}

IdleWatch::~IdleWatch() {
  // Destroyed after the lock is released: gRPC may wait for a callback that waits for the lock.
  std::unique_ptr<grpc::Alarm> last;
  const std::lock_guard lock(state_->mutex);
  state_->ended = true;
  last = std::move(state_->alarm);
}

void IdleWatch::NoteActivity() { state_->active = true; }

void IdleWatch::Pause() { state_->paused = true; }

// The alarm reads them in the other order, so that it sees at least one.
void IdleWatch::Resume() {
  state_->active = true;
  state_->paused = false;
}

void IdleWatch::SetAlarm(const std::shared_ptr<State>& state) {
  const std::lock_guard lock(state->mutex);
  state->active = false;
  auto alarm = std::make_unique<grpc::Alarm>();
  alarm->Set(std::chrono::system_clock::now() + state->limit, [state](bool expired) {
    const std::lock_guard callback_lock(state->mutex);
    if (!expired || state->ended) return;
    if (state->paused || state->active) return SetAlarm(state);
    state->on_idle();
  });
  state->alarm.swap(alarm);
}

}  // namespace albtpu::server
