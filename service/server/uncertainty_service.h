// The methods of albtpu.v1.UncertaintyService: messages in, messages out. The .proto says what each does.
#pragma once

#include <grpcpp/grpcpp.h>

#include "albtpu/v1/uncertainty_service.grpc.pb.h"
#include "service/server/table_catalog.h"

namespace albtpu::server {

class UncertaintyService final : public v1::UncertaintyService::Service {
 public:
  // `catalog` must outlive the service.
  explicit UncertaintyService(const TableCatalog& catalog) : catalog_(catalog) {}

  grpc::Status QueryPulses(grpc::ServerContext* context, const v1::QueryPulsesRequest* request,
                           v1::QueryPulsesResponse* response) override;
  grpc::Status QueryColumns(grpc::ServerContext* context, const v1::QueryColumnsRequest* request,
                            v1::QueryColumnsResponse* response) override;
  grpc::Status ListTables(grpc::ServerContext* context, const v1::ListTablesRequest* request,
                          v1::ListTablesResponse* response) override;
  grpc::Status GetTable(grpc::ServerContext* context, const v1::GetTableRequest* request,
                        v1::GetTableResponse* response) override;

 private:
  const TableCatalog& catalog_;
};

}  // namespace albtpu::server
