#include "service/server/ground/errors.h"

#include <spdlog/spdlog.h>

#include <string>

#include "absl/strings/cord.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "google/rpc/status.pb.h"
#include "service/server/ground/limits.h"

namespace albtpu::server {
namespace {

constexpr char kBadRequestUrl[] = "type.googleapis.com/google.rpc.BadRequest";

// Cut to kMaxErrorBytes, never within a character of UTF-8.
std::string Shortened(absl::string_view message) {
  if (message.size() <= kMaxErrorBytes) return std::string(message);
  std::size_t size = kMaxErrorBytes;
  while (size > 0 && (static_cast<unsigned char>(message[size]) & 0xC0) == 0x80) --size;
  return std::string(message.substr(0, size)) + "...";
}

// Code, message and details of `status`.
grpc::Status WithDetails(const absl::Status& status) {
  google::rpc::Status rich;
  status.ForEachPayload([&rich](absl::string_view type_url, const absl::Cord& payload) {
    if (!absl::StartsWith(type_url, "type.googleapis.com/")) return;
    google::protobuf::Any& detail = *rich.add_details();
    detail.set_type_url(std::string(type_url));
    detail.set_value(std::string(payload));
  });
  // absl::StatusCode and grpc::StatusCode have the same numbers by definition.
  const auto code = static_cast<grpc::StatusCode>(status.code());
  const std::string message = Shortened(status.message());
  if (rich.details().empty()) return grpc::Status(code, message);
  rich.set_code(code);
  rich.set_message(message);
  return grpc::Status(code, message, rich.SerializeAsString());
}

}  // namespace

void FieldViolations::Add(std::string_view field, std::string_view description) {
  google::rpc::BadRequest::FieldViolation& violation = *request_.add_field_violations();
  violation.set_field(std::string(field));
  violation.set_description(Shortened({description.data(), description.size()}));
}

absl::Status FieldViolations::ToStatus() const {
  if (request_.field_violations().empty()) return absl::OkStatus();
  absl::Status status = absl::InvalidArgumentError(request_.field_violations(0).description());
  status.SetPayload(kBadRequestUrl, absl::Cord(request_.SerializeAsString()));
  return status;
}

absl::Status FieldViolation(std::string_view field, std::string_view description) {
  FieldViolations violations;
  violations.Add(field, description);
  return violations.ToStatus();
}

absl::Status Within(std::string_view outer, const absl::Status& status) {
  const absl::optional<absl::Cord> payload = status.GetPayload(kBadRequestUrl);
  google::rpc::BadRequest request;
  if (!payload.has_value() || !request.ParseFromString(std::string(*payload))) return status;
  for (google::rpc::BadRequest::FieldViolation& violation : *request.mutable_field_violations())
    violation.set_field(absl::StrCat(std::string(outer), ".", violation.field()));
  absl::Status same = status;
  same.SetPayload(kBadRequestUrl, absl::Cord(request.SerializeAsString()));
  return same;
}

grpc::Status ToGrpcStatus(const absl::Status& status) {
  switch (status.code()) {
    case absl::StatusCode::kOk:
      return grpc::Status::OK;
    case absl::StatusCode::kInvalidArgument:
    case absl::StatusCode::kNotFound:
    case absl::StatusCode::kFailedPrecondition:
    case absl::StatusCode::kPermissionDenied:
    case absl::StatusCode::kResourceExhausted:  // By a limit in limits.h.
    case absl::StatusCode::kDeadlineExceeded:   // By limits.h, or by the caller.
    case absl::StatusCode::kCancelled:          // By the caller.
    case absl::StatusCode::kUnavailable:        // The request did not arrive completely.
      return WithDetails(status);
    default:
      spdlog::error("call failed: {}", status.ToString());
      return grpc::Status(grpc::StatusCode::INTERNAL, "internal error (details are in the log of the server)");
  }
}

}  // namespace albtpu::server
