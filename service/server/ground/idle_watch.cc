#include "service/server/ground/idle_watch.h"

#include <atomic>
#include <utility>

namespace albtpu::server {

// Outlives the watch while its alarm is on.
struct IdleWatch::State {
  const std::chrono::milliseconds limit;
  std::function<void()> on_idle;
  std::atomic<bool> moved = true;
  std::recursive_mutex mutex{};             // `on_idle` may well end the watch.
  bool ended = false;                       // Guarded by mutex.
  std::unique_ptr<grpc::Alarm> alarm = {};  // As is this: one for each time, it holds what it calls.
};

IdleWatch::IdleWatch(std::chrono::milliseconds limit, std::function<void()> on_idle)
    : state_(new State{.limit = limit, .on_idle = std::move(on_idle)}) {
  Wait(state_);
}

IdleWatch::~IdleWatch() {
  // Goes when the lock is open: gRPC may wait for what waits for the lock.
  std::unique_ptr<grpc::Alarm> last;
  const std::lock_guard lock(state_->mutex);
  state_->ended = true;
  last = std::move(state_->alarm);
}

void IdleWatch::Moved() { state_->moved = true; }

void IdleWatch::Wait(const std::shared_ptr<State>& state) {
  const std::lock_guard lock(state->mutex);
  state->moved = false;
  auto alarm = std::make_unique<grpc::Alarm>();
  alarm->Set(std::chrono::system_clock::now() + state->limit, [state](bool expired) {
    const std::lock_guard callback_lock(state->mutex);
    if (!expired || state->ended) return;
    if (state->moved) return Wait(state);
    state->on_idle();
  });
  state->alarm.swap(alarm);
}

}  // namespace albtpu::server
