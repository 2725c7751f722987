// The methods of albtpu.v1.UncertaintyService, which uncertainty_service.proto documents.
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>

#include "albtpu/v1/uncertainty_service.grpc.pb.h"
#include "service/server/calls/message_handlers.h"
#include "service/server/calls/sea_tables.h"
#include "service/server/calls/unread_answers.h"
#include "service/server/ground/workers.h"
#include "service/server/observe/records.h"
#include "service/server/tables/live_tables.h"

namespace albtpu::server {

// Messages with many pulses are received and sent as bytes, so that a worker parses and serializes them.
using UncertaintyServiceOfBytes = v1::UncertaintyService::WithRawCallbackMethod_QueryPulses<
    v1::UncertaintyService::WithRawCallbackMethod_QueryColumns<
        v1::UncertaintyService::WithRawCallbackMethod_StreamColumns<
            v1::UncertaintyService::WithRawCallbackMethod_QueryBudget<
                v1::UncertaintyService::WithCallbackMethod_ListTables<
                    v1::UncertaintyService::WithCallbackMethod_GetTable<
                        v1::UncertaintyService::WithRawCallbackMethod_CompileSea<
                            v1::UncertaintyService::Service>>>>>>>;

class UncertaintyService final : public UncertaintyServiceOfBytes {
 public:
  // `tables` and `recorders` must outlive the service. Streams without activity and unread answers end after
  // `max_stream_idle`.
  UncertaintyService(const LiveTables& tables, const Recorders& recorders,
                     std::chrono::seconds max_stream_idle)
      : tables_(tables),
        recorders_(recorders),
        max_stream_idle_(max_stream_idle),
        unread_(recorders.metrics, max_stream_idle),
        seas_(recorders.seas, recorders.log) {}

  grpc::ServerUnaryReactor* QueryPulses(grpc::CallbackServerContext* context, const grpc::ByteBuffer* request,
                                        grpc::ByteBuffer* response) override;
  grpc::ServerUnaryReactor* QueryColumns(grpc::CallbackServerContext* context,
                                         const grpc::ByteBuffer* request,
                                         grpc::ByteBuffer* response) override;
  grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>* StreamColumns(
      grpc::CallbackServerContext* context) override;
  grpc::ServerUnaryReactor* QueryBudget(grpc::CallbackServerContext* context, const grpc::ByteBuffer* request,
                                        grpc::ByteBuffer* response) override;
  grpc::ServerUnaryReactor* ListTables(grpc::CallbackServerContext* context,
                                       const v1::ListTablesRequest* request,
                                       v1::ListTablesResponse* response) override;
  grpc::ServerUnaryReactor* GetTable(grpc::CallbackServerContext* context, const v1::GetTableRequest* request,
                                     v1::GetTableResponse* response) override;
  grpc::ServerUnaryReactor* CompileSea(grpc::CallbackServerContext* context, const grpc::ByteBuffer* request,
                                       grpc::ByteBuffer* response) override;

 private:
  class LongCall;

  // Handles requests up to `inline_bytes` at once, unless their sea is to be compiled first; others on a worker.
  grpc::ServerUnaryReactor* Handle(Method method, MessageHandler handler, std::size_t inline_bytes,
                                   grpc::CallbackServerContext& context, const grpc::ByteBuffer& request,
                                   grpc::ByteBuffer& response);

  const LiveTables& tables_;
  const Recorders& recorders_;
  const std::chrono::seconds max_stream_idle_;
  Workers workers_;
  UnreadAnswers unread_;
  SeaTables seas_;
};

}  // namespace albtpu::server
