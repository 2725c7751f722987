// The methods of albtpu.v1.UncertaintyService. The .proto says what each does.
#pragma once

#include <grpcpp/grpcpp.h>

#include "albtpu/v1/uncertainty_service.grpc.pb.h"
#include "service/server/calls/byte_answers.h"
#include "service/server/calls/unread_answers.h"
#include "service/server/ground/workers.h"
#include "service/server/observe/call_record.h"
#include "service/server/tables/live_tables.h"

namespace albtpu::server {

// Messages of many pulses come and go as bytes, so that it is on a worker that they are read and written.
using UncertaintyServiceOfBytes = v1::UncertaintyService::WithRawCallbackMethod_QueryPulses<
    v1::UncertaintyService::WithRawCallbackMethod_QueryColumns<
        v1::UncertaintyService::WithRawCallbackMethod_StreamColumns<
            v1::UncertaintyService::WithCallbackMethod_ListTables<
                v1::UncertaintyService::WithCallbackMethod_GetTable<v1::UncertaintyService::Service>>>>>;

class UncertaintyService final : public UncertaintyServiceOfBytes {
 public:
  // Both must outlive the service.
  UncertaintyService(const LiveTables& tables, const CallRecords& records)
      : tables_(tables), records_(records), unread_(records.metrics) {}

  grpc::ServerUnaryReactor* QueryPulses(grpc::CallbackServerContext* context, const grpc::ByteBuffer* request,
                                        grpc::ByteBuffer* response) override;
  grpc::ServerUnaryReactor* QueryColumns(grpc::CallbackServerContext* context,
                                         const grpc::ByteBuffer* request,
                                         grpc::ByteBuffer* response) override;
  grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>* StreamColumns(
      grpc::CallbackServerContext* context) override;
  grpc::ServerUnaryReactor* ListTables(grpc::CallbackServerContext* context,
                                       const v1::ListTablesRequest* request,
                                       v1::ListTablesResponse* response) override;
  grpc::ServerUnaryReactor* GetTable(grpc::CallbackServerContext* context, const v1::GetTableRequest* request,
                                     v1::GetTableResponse* response) override;

 private:
  // Short requests at once, long ones on a worker.
  grpc::ServerUnaryReactor* Answer(Method method, ByteAnswer answer, grpc::CallbackServerContext& context,
                                   const grpc::ByteBuffer& request, grpc::ByteBuffer& response);

  const LiveTables& tables_;
  const CallRecords& records_;
  Workers workers_;
  UnreadAnswers unread_;
};

}  // namespace albtpu::server
