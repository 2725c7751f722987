// Where connections come in.
#pragma once

#include <grpcpp/server_builder.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "service/server/connections/connection_calls.h"
#include "service/server/ground/listening_sockets.h"
#include "service/server/observe/access_metrics.h"

namespace albtpu::server {

// Takes connections and hands them over to gRPC, never more at a time than kMaxConnections, and some of
// kOwnDescriptors that are free, nor than the system lets the process have open: further ones are closed at
// once, and those open stay as they are.
//
// gRPC 1.51 does not take connections itself: when it once cannot, because too many files are open, it stops
// listening for good and says so in a line of the log.
class ConnectionGate {
 public:
  using Acceptor = grpc::experimental::ExternalConnectionAcceptor;

  // Raises the limit of the process on open files as far as it may.
  // Counts those that it refuses in `metrics`.
  ConnectionGate(std::vector<ListeningSocket> sockets, std::unique_ptr<Acceptor> acceptor,
                 AccessMetrics& metrics);

  // Stops to listen.
  ~ConnectionGate();

  // Ends the connections of these callers at once: what they have sent and is not read yet is not read any
  // more. Returns those who had one.
  std::vector<Caller> End(const std::vector<Caller>& callers);

 private:
  void Run();
  void AcceptSome(const ListeningSocket& socket);
  void Refuse(int connection);

  const std::vector<ListeningSocket> sockets_;
  const std::unique_ptr<Acceptor> acceptor_;
  AccessMetrics& metrics_;
  const int end_of_descriptors_;  // A connection from here on is one too many.
  const int stop_;                // Readable when it is time to stop.
  int refused_ = 0;               // Since the last line of the log about it.
  std::chrono::steady_clock::time_point next_line_{};
  std::mutex taking_;  // No connection is taken while it is held.
  std::thread thread_;
};

}  // namespace albtpu::server
