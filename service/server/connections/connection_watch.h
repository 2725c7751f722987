// Ends connections that have more calls in memory than a connection may.
#pragma once

#include <functional>
#include <vector>

#include "service/server/connections/connection_calls.h"
#include "service/server/ground/repeated.h"

namespace albtpu::server {

// Who is to go: each connection with more than kMaxCallsInMemory, and, while all together have more than
// kMaxCallsOfAll, that with the most.
std::vector<Caller> CallersToEnd(std::vector<ConnectionCalls> connections);

// Looks at the memory of the process every kMemoryLook, and at its connections whenever it has grown by
// kMemoryGrowth. So watching costs a call nothing, and finds calls, too, that never reach a method: gRPC 1.51
// limits neither those that are taken back at once nor those of a connection that does not acknowledge its
// settings (HTTP/2, RFC 9113, 6.5.3), and makes them faster than their methods could count them.
class ConnectionWatch {
 public:
  // `end` is called with those whom CallersToEnd() names if there are any, from the thread that watches.
  explicit ConnectionWatch(std::function<void(const std::vector<Caller>&)> end);

 private:
  void Look();

  const std::function<void(const std::vector<Caller>&)> end_;
  double resident_bytes_;  // When connections were last looked at, or less if less was seen since.
  Repeated looking_;       // Goes first.
};

}  // namespace albtpu::server
