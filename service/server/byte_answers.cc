#include "service/server/byte_answers.h"

#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/support/proto_buffer_reader.h>

#include <exception>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/server/answer_columns.h"
#include "service/server/pulse_rows.h"
#include "service/server/status.h"

namespace albtpu::server {
namespace {

template <typename Message>
bool Parse(const grpc::ByteBuffer& bytes, Message& message) {
  grpc::ByteBuffer same = bytes;  // Shares the bytes; reading takes a buffer that may be changed.
  grpc::ProtoBufferReader reader(&same);
  return reader.status().ok() && message.ParseFromZeroCopyStream(&reader);
}

template <typename Request, typename Response>
grpc::Status Answer(absl::Status (*answer)(const TableCatalog&, const Request&, Response&),
                    const TableCatalog& catalog, const grpc::ByteBuffer& request,
                    grpc::ByteBuffer& response) try {
  Request question;
  if (!Parse(request, question)) {
    return ToGrpcStatus(absl::InvalidArgumentError(absl::StrCat(
        "the message is no ", question.GetTypeName(), ": its bytes do not parse as one")));
  }
  Response message;
  const absl::Status status = answer(catalog, question, message);
  if (!status.ok()) return ToGrpcStatus(status);
  bool own = false;
  return grpc::SerializationTraits<Response>::Serialize(message, &response, &own);
} catch (const std::exception& error) {
  return ToGrpcStatus(absl::InternalError(error.what()));
}

absl::Status AnswerExchange(const TableCatalog& catalog, const v1::StreamColumnsRequest& request,
                            v1::StreamColumnsResponse& response) {
  return AnswerInColumns(catalog, request.query(), *response.mutable_answer());
}

}  // namespace

grpc::Status AnswerQueryPulses(const TableCatalog& catalog, const grpc::ByteBuffer& request,
                               grpc::ByteBuffer& response) {
  return Answer(AnswerInRows, catalog, request, response);
}

grpc::Status AnswerQueryColumns(const TableCatalog& catalog, const grpc::ByteBuffer& request,
                                grpc::ByteBuffer& response) {
  return Answer(AnswerInColumns, catalog, request, response);
}

grpc::Status AnswerStreamColumns(const TableCatalog& catalog, const grpc::ByteBuffer& request,
                                 grpc::ByteBuffer& response) {
  return Answer(AnswerExchange, catalog, request, response);
}

}  // namespace albtpu::server
