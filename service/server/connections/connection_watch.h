// Finds connections that have too many calls in memory.
#pragma once

#include <functional>
#include <vector>

#include "service/server/connections/connection_calls.h"
#include "service/server/ground/periodic_task.h"

namespace albtpu::server {

// The callers with more than kMaxCallsInMemory calls and, while all remaining connections together have more than
// kMaxTotalCallsInMemory, those with the most.
std::vector<Caller> CallersToDisconnect(std::vector<ConnectionCalls> connections);

// Checks the memory of the process every kMemoryCheckInterval, and its connections whenever the memory has grown by
// kMemoryGrowth. This costs a call nothing and also finds calls that never reach a method. gRPC 1.51 limits neither
// calls that are cancelled at once nor calls of a connection that does not acknowledge its settings (HTTP/2, RFC 9113,
// 6.5.3), and creates them faster than the methods could count them.
class ConnectionWatch {
 public:
  // Calls `disconnect` with the result of CallersToDisconnect(), unless that is empty, from the thread of the watch.
  explicit ConnectionWatch(std::function<void(const std::vector<Caller>&)> disconnect);

 private:
  void Check();

  const std::function<void(const std::vector<Caller>&)> disconnect_;
  double resident_bytes_;  // At the last check of the connections, or less if the memory has shrunk since.
  PeriodicTask checking_;  // Last, so that it is destroyed first.
};

}  // namespace albtpu::server
