#include "service/server/tables/field_violations.h"

#include <string>

#include "absl/strings/cord.h"
#include "absl/strings/str_cat.h"

namespace albtpu::server {
namespace {

constexpr char kTypeUrl[] = "type.googleapis.com/google.rpc.BadRequest";

}  // namespace

void FieldViolations::Add(std::string_view field, std::string_view description) {
  google::rpc::BadRequest::FieldViolation& violation = *request_.add_field_violations();
  violation.set_field(std::string(field));
  violation.set_description(std::string(description));
}

absl::Status FieldViolations::ToStatus() const {
  if (request_.field_violations().empty()) return absl::OkStatus();
  absl::Status status = absl::InvalidArgumentError(request_.field_violations(0).description());
  status.SetPayload(kTypeUrl, absl::Cord(request_.SerializeAsString()));
  return status;
}

absl::Status FieldViolation(std::string_view field, std::string_view description) {
  FieldViolations violations;
  violations.Add(field, description);
  return violations.ToStatus();
}

absl::Status Within(std::string_view outer, const absl::Status& status) {
  const absl::optional<absl::Cord> payload = status.GetPayload(kTypeUrl);
  google::rpc::BadRequest request;
  if (!payload.has_value() || !request.ParseFromString(std::string(*payload))) return status;
  for (google::rpc::BadRequest::FieldViolation& violation : *request.mutable_field_violations()) {
    violation.set_field(absl::StrCat(std::string(outer), ".", violation.field()));
  }
  absl::Status same = status;
  same.SetPayload(kTypeUrl, absl::Cord(request.SerializeAsString()));
  return same;
}

}  // namespace albtpu::server
