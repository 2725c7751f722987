// A listening server: the uncertainty service with health (grpc.health.v1) and reflection.
#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "service/server/health_service.h"
#include "service/server/listen_address.h"
#include "service/server/table_catalog.h"
#include "service/server/uncertainty_service.h"

namespace albtpu::server {

class Server {
 public:
  // Listens in plain text and answers from `catalog`, which must outlive the server. Unavailable, with the
  // reason, when it cannot listen.
  static absl::StatusOr<std::unique_ptr<Server>> Start(const TableCatalog& catalog,
                                                       const ListenAddress& address);

  // HOST:PORT with the port that is listened on.
  const std::string& address() const { return address_; }

  // Says NOT_SERVING to those that ask for health, takes no new call, and returns when all calls under way
  // have ended or kDrainTime has passed.
  void Drain();

 private:
  explicit Server(const TableCatalog& catalog);

  UncertaintyService service_;
  HealthService health_;
  std::unique_ptr<grpc::Server> server_;
  std::string address_;
};

}  // namespace albtpu::server
