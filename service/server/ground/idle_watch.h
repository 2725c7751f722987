// Notices that nothing has moved for a while.
#pragma once

#include <grpcpp/alarm.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>

namespace albtpu::server {

class IdleWatch {
 public:
  // Calls `on_idle` once, from a thread of gRPC, when Moved() has not been called for `limit`, up to twice as
  // long.
  IdleWatch(std::chrono::milliseconds limit, std::function<void()> on_idle);

  // Waits for an `on_idle` that runs; none runs thereafter.
  ~IdleWatch();

  IdleWatch(const IdleWatch&) = delete;
  IdleWatch& operator=(const IdleWatch&) = delete;

  void Moved();

 private:
  struct State;
  static void Wait(const std::shared_ptr<State>& state);

  std::shared_ptr<State> state_;
};

}  // namespace albtpu::server
