// The services for operators: grpc.health.v1.Health and albtpu.v1.AdminService.
#pragma once

#include <grpcpp/grpcpp.h>

#include <mutex>
#include <set>
#include <string>

#include "albtpu/v1/admin_service.grpc.pb.h"
#include "grpc/health/v1/health.grpc.pb.h"
#include "service/server/observe/log.h"
#include "service/server/tables/table_catalog.h"

namespace albtpu::server {

// grpc.health.v1.Health. The implementation in gRPC cannot be described by reflection, and it does not end the streams
// of watchers, for which a drain would wait in vain.

// Reports the server as a whole, and each of its services, as SERVING until StopServing().
class HealthService final : public grpc::health::v1::Health::CallbackService {
 public:
  explicit HealthService(std::set<std::string> services) : services_(std::move(services)) {}

  // Reports NOT_SERVING from now on, notifies the watchers and ends their streams.
  void StopServing();

  grpc::ServerUnaryReactor* Check(grpc::CallbackServerContext* context,
                                  const grpc::health::v1::HealthCheckRequest* request,
                                  grpc::health::v1::HealthCheckResponse* response) override;
  grpc::ServerWriteReactor<grpc::health::v1::HealthCheckResponse>* Watch(
      grpc::CallbackServerContext* context, const grpc::health::v1::HealthCheckRequest* request) override;

 private:
  class Watcher;

  bool Knows(const std::string& name) const { return name.empty() || services_.count(name) > 0; }

  const std::set<std::string> services_;
  std::mutex mutex_;
  bool serving_ = true;          // Guarded by mutex_.
  std::set<Watcher*> watchers_;  // Guarded by mutex_.
};

// The methods of albtpu.v1.AdminService, which admin_service.proto documents.

// The callers that are accepted.
enum class AdminCallers {
  kLocal,  // Callers on this machine, by their address. A proxy on this machine hides its clients.
  kAll,    // Everyone. For servers that authenticate all callers.
};

class AdminService final : public v1::AdminService::CallbackService {
 public:
  // `tables` and `recorders` must outlive the service.
  AdminService(LiveTables& tables, const Recorders& recorders, AdminCallers callers)
      : tables_(tables), recorders_(recorders), callers_(callers) {}

  grpc::ServerUnaryReactor* ReloadTables(grpc::CallbackServerContext* context, const v1::ReloadTablesRequest* request,
                                         v1::ReloadTablesResponse* response) override;

 private:
  LiveTables& tables_;
  const Recorders& recorders_;
  const AdminCallers callers_;
};

// Whether `peer`, as gRPC writes it, is an address that only this machine can have: ipv4:127.0.0.1:4242,
// ipv6:%5B::1%5D:4242 or a unix socket.
bool IsLocalPeer(std::string_view peer);

}  // namespace albtpu::server
