// The methods of albtpu.v1.AdminService. The .proto says what each does.
#pragma once

#include <grpcpp/grpcpp.h>

#include "albtpu/v1/admin_service.grpc.pb.h"
#include "service/server/observe/call_record.h"
#include "service/server/tables/live_tables.h"

namespace albtpu::server {

// Whose calls are served.
enum class AdminCallers {
  kOfThisMachine,  // By the address that they come from. A proxy on this machine hides who is behind it.
  kAll,            // Where no call gets this far whose caller has not proved who it is.
};

class AdminService final : public v1::AdminService::CallbackService {
 public:
  // `tables` and `records` must outlive the service.
  AdminService(LiveTables& tables, const CallRecords& records, AdminCallers callers)
      : tables_(tables), records_(records), callers_(callers) {}

  grpc::ServerUnaryReactor* ReloadTables(grpc::CallbackServerContext* context,
                                         const v1::ReloadTablesRequest* request,
                                         v1::ReloadTablesResponse* response) override;

 private:
  LiveTables& tables_;
  const CallRecords& records_;
  const AdminCallers callers_;
};

// Whether `peer`, as gRPC writes it, is an address of this machine alone: ipv4:127.0.0.1:4242,
// ipv6:%5B::1%5D:4242 or a unix socket.
bool IsOfThisMachine(std::string_view peer);

}  // namespace albtpu::server
