#include "service/server/calls/message_handlers.h"

#include <grpcpp/support/proto_buffer_reader.h>

#include <exception>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/column_message.h"
#include "service/server/calls/describe_sea.h"
#include "service/server/calls/query_budget.h"
#include "service/server/calls/query_columns.h"
#include "service/server/calls/query_rows.h"
#include "service/server/ground/errors.h"

namespace albtpu::server {
namespace {

template <typename Message>
bool Parse(const grpc::ByteBuffer& bytes, Message& message) {
  grpc::ByteBuffer shared = bytes;  // Shares the bytes. The reader requires a buffer that is not const.
  grpc::ProtoBufferReader reader(&shared);
  return reader.status().ok() && message.ParseFromZeroCopyStream(&reader);
}

// Calls `query` with the parsed request and returns its status.
template <typename Request, typename Query>
grpc::Status HandleParsed(const grpc::ByteBuffer& bytes, Query query) try {
  Request request;
  if (Parse(bytes, request)) return ToGrpcStatus(query(request));
  return ToGrpcStatus(absl::InvalidArgumentError(
      absl::StrCat("the message is not a valid ", request.GetTypeName(), " (its bytes do not parse)")));
} catch (const std::exception& error) {
  return ToGrpcStatus(absl::InternalError(error.what()));
}

grpc::ByteBuffer Serialize(const google::protobuf::Message& message) {
  ColumnMessage bytes;
  bytes.Add(message);
  return bytes.Finish();
}

}  // namespace

grpc::Status HandleQueryPulses(AnswerSources& sources, const grpc::ByteBuffer& request,
                               grpc::ByteBuffer& response, OutcomeTally& tally) {
  return HandleParsed<v1::QueryPulsesRequest>(request, [&](const v1::QueryPulsesRequest& rows) {
    v1::QueryPulsesResponse answers;
    const absl::Status status = QueryRows(sources, rows, answers, tally);
    if (status.ok()) response = Serialize(answers);
    return status;
  });
}

grpc::Status HandleQueryColumns(AnswerSources& sources, const grpc::ByteBuffer& request,
                                grpc::ByteBuffer& response, OutcomeTally& tally) {
  return HandleParsed<v1::QueryColumnsRequest>(request, [&](const v1::QueryColumnsRequest& columns) {
    ColumnMessage answers;
    const absl::Status status = QueryColumns(sources, columns, answers, tally);
    if (status.ok()) response = answers.Finish();
    return status;
  });
}

grpc::Status HandleQueryBudget(AnswerSources& sources, const grpc::ByteBuffer& request,
                               grpc::ByteBuffer& response, OutcomeTally& tally) {
  return HandleParsed<v1::QueryBudgetRequest>(request, [&](const v1::QueryBudgetRequest& pulses) {
    ColumnMessage answers;
    const absl::Status status = QueryBudget(sources, pulses, answers, tally);
    if (status.ok()) response = answers.Finish();
    return status;
  });
}

grpc::Status HandleCompileSea(AnswerSources& sources, const grpc::ByteBuffer& request,
                              grpc::ByteBuffer& response, OutcomeTally& /*tally*/) {
  return HandleParsed<v1::CompileSeaRequest>(request, [&](const v1::CompileSeaRequest& wanted) {
    v1::CompileSeaResponse compiled;
    const absl::Status status = DescribeSea(sources, wanted, compiled);
    if (status.ok()) response = Serialize(compiled);
    return status;
  });
}

grpc::Status HandleStreamColumns(AnswerSources& sources, const grpc::ByteBuffer& request,
                                 grpc::ByteBuffer& response, OutcomeTally& tally) {
  return HandleParsed<v1::StreamColumnsRequest>(request, [&](const v1::StreamColumnsRequest& exchange) {
    ColumnMessage answers;
    const absl::Status status = Within("query", QueryColumns(sources, exchange.query(), answers, tally));
    answers.Nest(v1::StreamColumnsResponse::kAnswerFieldNumber, 0);
    if (status.ok()) response = answers.Finish();
    return status;
  });
}

}  // namespace albtpu::server
