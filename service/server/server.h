// A running server: the services of albtpu.v1 with health (grpc.health.v1) and reflection.
#pragma once

#include <grpcpp/grpcpp.h>
#include <grpcpp/security/server_credentials.h>

#include <chrono>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "service/server/calls/health_service.h"
#include "service/server/calls/uncertainty_service.h"
#include "service/server/connections/connection_gate.h"
#include "service/server/ground/limits.h"
#include "service/server/ground/listening_sockets.h"
#include "service/server/observe/log.h"
#include "service/server/tables/table_catalog.h"

namespace albtpu::server {

// The access to the server.
struct Access {
  std::shared_ptr<grpc::ServerCredentials> credentials = grpc::InsecureServerCredentials();  // credentials.h
  AdminCallers admin = AdminCallers::kLocal;
};

class Server {
 public:
  // Listens and serves `tables`. They and the objects that `recorders` refers to must outlive the server. Unavailable,
  // with the reason, if it cannot listen.
  static absl::StatusOr<std::unique_ptr<Server>> Start(LiveTables& tables, const Recorders& recorders,
                                                       const ListenAddress& address, Access access = {},
                                                       std::chrono::seconds max_stream_idle = kMaxStreamIdle);

  // HOST:PORT with the actual port.
  const std::string& address() const { return address_; }

  // Reports NOT_SERVING as its health, accepts no new call, and returns when all calls in progress have ended or
  // kDrainTime has passed. A reload in progress is finished.
  void Drain();

 private:
  Server(LiveTables& tables, const Recorders& recorders, Access access, std::chrono::seconds max_stream_idle);

  std::shared_ptr<grpc::ServerCredentials> credentials_;  // Must outlive the listener.
  const Recorders recorders_;
  UncertaintyService service_;
  AdminService admin_;
  HealthService health_;
  std::unique_ptr<grpc::Server> server_;
  std::string address_;
  std::unique_ptr<ConnectionGate> gate_;
  std::unique_ptr<ConnectionWatch> watch_;
};

}  // namespace albtpu::server
