// The methods of albtpu.v1.AdminService, which admin_service.proto documents.
#pragma once

#include <grpcpp/grpcpp.h>

#include "albtpu/v1/admin_service.grpc.pb.h"
#include "service/server/observe/records.h"
#include "service/server/tables/live_tables.h"

namespace albtpu::server {

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

  grpc::ServerUnaryReactor* ReloadTables(grpc::CallbackServerContext* context,
                                         const v1::ReloadTablesRequest* request,
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
