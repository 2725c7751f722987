#include "service/server/calls/byte_answers.h"

#include <grpcpp/support/proto_buffer_reader.h>

#include <exception>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/column_message.h"
#include "service/server/calls/answer_columns.h"
#include "service/server/calls/pulse_rows.h"
#include "service/server/ground/status.h"
#include "service/server/tables/field_violations.h"

namespace albtpu::server {
namespace {

template <typename Message>
bool Parse(const grpc::ByteBuffer& bytes, Message& message) {
  grpc::ByteBuffer same = bytes;  // Shares the bytes; reading takes a buffer that may be changed.
  grpc::ProtoBufferReader reader(&same);
  return reader.status().ok() && message.ParseFromZeroCopyStream(&reader);
}

// `answer` is called with the request, read, and returns its status.
template <typename Request, typename Answer>
grpc::Status ToRequest(const grpc::ByteBuffer& bytes, Answer answer) try {
  Request request;
  if (Parse(bytes, request)) return ToGrpcStatus(answer(request));
  return ToGrpcStatus(absl::InvalidArgumentError(
      absl::StrCat("the message is no ", request.GetTypeName(), ": its bytes do not parse as one")));
} catch (const std::exception& error) {
  return ToGrpcStatus(absl::InternalError(error.what()));
}

grpc::ByteBuffer Serialized(const google::protobuf::Message& message) {
  ColumnMessage bytes;
  bytes.Add(message);
  return bytes.Finish();
}

}  // namespace

grpc::Status AnswerQueryPulses(const TableCatalog& catalog, const grpc::ByteBuffer& request,
                               grpc::ByteBuffer& response, OutcomeTally& tally) {
  return ToRequest<v1::QueryPulsesRequest>(request, [&](const v1::QueryPulsesRequest& rows) {
    v1::QueryPulsesResponse answers;
    const absl::Status status = AnswerInRows(catalog, rows, answers, tally);
    if (status.ok()) response = Serialized(answers);
    return status;
  });
}

grpc::Status AnswerQueryColumns(const TableCatalog& catalog, const grpc::ByteBuffer& request,
                                grpc::ByteBuffer& response, OutcomeTally& tally) {
  return ToRequest<v1::QueryColumnsRequest>(request, [&](const v1::QueryColumnsRequest& columns) {
    ColumnMessage answers;
    const absl::Status status = AnswerInColumns(catalog, columns, answers, tally);
    if (status.ok()) response = answers.Finish();
    return status;
  });
}

grpc::Status AnswerStreamColumns(const TableCatalog& catalog, const grpc::ByteBuffer& request,
                                 grpc::ByteBuffer& response, OutcomeTally& tally) {
  return ToRequest<v1::StreamColumnsRequest>(request, [&](const v1::StreamColumnsRequest& exchange) {
    ColumnMessage answers;
    const absl::Status status = Within("query", AnswerInColumns(catalog, exchange.query(), answers, tally));
    answers.Nest(v1::StreamColumnsResponse::kAnswerFieldNumber, 0);
    if (status.ok()) response = answers.Finish();
    return status;
  });
}

}  // namespace albtpu::server
