// Limits of connections: accepts them up to a number, counts the calls that each has in memory, and disconnects those
// with too many.
#pragma once

#include <grpcpp/server_builder.h>

#include <chrono>
#include <compare>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "service/server/ground/listening_sockets.h"
#include "service/server/ground/periodic_task.h"
#include "service/server/observe/metrics.h"

namespace albtpu::server {

// Counts the calls that each connection has in memory.

// The remote end of a connection.
struct Caller {
  std::string address;  // 4 bytes for IPv4, also if mapped to IPv6; otherwise 16.
  int port = 0;

  auto operator<=>(const Caller&) const = default;
};

// As gRPC writes it: ipv4:127.0.0.1:4242, ipv6:%5B::1%5D:4242.
std::string ToText(const Caller& caller);

// The caller at the other end of a socket. Its address is empty if the descriptor is not a connection.
Caller CallerOf(int descriptor);

struct ConnectionCalls {
  Caller caller;
  long calls = 0;
};

// Calls of all connections to servers in this process, as gRPC counts them for channelz: from the first byte of their
// header until they are freed, whether cancelled, answered or never sent completely. They take memory for that time.
// Takes about 20 us for each connection.
std::vector<ConnectionCalls> CountConnectionCalls();

// Finds connections that have too many calls in memory.

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

// Accepts connections and hands them to gRPC. At most kMaxConnections, plus a part of kOwnDescriptors that is not used
// otherwise, are open at a time, and no more than the operating system allows. Further connections are closed at once;
// open ones are not affected.
//
// gRPC 1.51 cannot be left to accept connections: if that fails once, because too many files are open, it logs a line
// and stops listening for good.
class ConnectionGate {
 public:
  using Acceptor = grpc::experimental::ExternalConnectionAcceptor;

  // Raises the limit of the process on open files as far as allowed. Counts refused connections in `metrics`.
  ConnectionGate(std::vector<ListeningSocket> sockets, std::unique_ptr<Acceptor> acceptor, AccessMetrics& metrics);

  // Stops listening.
  ~ConnectionGate();

  // Closes the connections of these callers at once, without reading what they have sent. Returns the callers that had
  // a connection.
  std::vector<Caller> Disconnect(const std::vector<Caller>& callers);

 private:
  void Run();
  void AcceptSome(const ListeningSocket& socket);
  void Refuse(int connection);

  const std::vector<ListeningSocket> sockets_;
  const std::unique_ptr<Acceptor> acceptor_;
  AccessMetrics& metrics_;
  const int descriptor_limit_;  // A connection with this descriptor or a higher one is refused.
  const int stop_;              // Becomes readable when the gate stops.
  int refused_ = 0;             // Since the last log line about refused connections.
  std::chrono::steady_clock::time_point next_line_{};
  std::mutex accept_mutex_;  // No connection is accepted while it is held.
  std::thread thread_;
};

}  // namespace albtpu::server
