// Accepts connections.
#pragma once

#include <grpcpp/server_builder.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "service/server/connections/connection_calls.h"
#include "service/server/ground/listening_sockets.h"
#include "service/server/observe/metrics.h"

namespace albtpu::server {

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
  ConnectionGate(std::vector<ListeningSocket> sockets, std::unique_ptr<Acceptor> acceptor,
                 AccessMetrics& metrics);

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
