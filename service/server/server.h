// A listening server: the services of albtpu.v1 with health (grpc.health.v1) and reflection.
#pragma once

#include <grpcpp/grpcpp.h>
#include <grpcpp/security/server_credentials.h>

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "service/server/calls/admin_service.h"
#include "service/server/calls/health_service.h"
#include "service/server/calls/uncertainty_service.h"
#include "service/server/connections/connection_gate.h"
#include "service/server/connections/connection_watch.h"
#include "service/server/ground/listen_address.h"
#include "service/server/observe/call_record.h"
#include "service/server/tables/live_tables.h"

namespace albtpu::server {

// Who may call, and how.
struct Access {
  std::shared_ptr<grpc::ServerCredentials> credentials = grpc::InsecureServerCredentials();  // credentials.h
  AdminCallers admin = AdminCallers::kOfThisMachine;
};

class Server {
 public:
  // Listens and answers from `tables`. These and what `records` refers to must outlive the server.
  // Unavailable, with the reason, when it cannot listen.
  static absl::StatusOr<std::unique_ptr<Server>> Start(LiveTables& tables, const CallRecords& records,
                                                       const ListenAddress& address, Access access = {});

  // HOST:PORT with the port that is listened on.
  const std::string& address() const { return address_; }

  // Says NOT_SERVING to those that ask for health, takes no new call, and returns when all calls under way
  // have ended or kDrainTime has passed. Tables that are being reloaded are read to the end.
  void Drain();

 private:
  Server(LiveTables& tables, const CallRecords& records, Access access);

  std::shared_ptr<grpc::ServerCredentials> credentials_;  // Outlive the listener.
  const CallRecords records_;
  UncertaintyService service_;
  AdminService admin_;
  HealthService health_;
  std::unique_ptr<grpc::Server> server_;
  std::string address_;
  std::unique_ptr<ConnectionGate> gate_;
  std::unique_ptr<ConnectionWatch> watch_;
};

}  // namespace albtpu::server
