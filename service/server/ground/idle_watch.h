// Notices that there has been no activity for a while.
#pragma once

#include <grpcpp/alarm.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>

namespace albtpu::server {

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

 private:
  struct State;
  static void SetAlarm(const std::shared_ptr<State>& state);

  std::shared_ptr<State> state_;
};

}  // namespace albtpu::server
