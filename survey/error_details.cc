#include "survey/error_details.h"

#include "absl/strings/cord.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "service/client/grpc_error.h"

namespace albtpu::client {

std::string MessageWithDetails(const absl::Status& status) {
  std::string message(status.message());
  const auto payload = status.GetPayload(absl::string_view(kErrorDetails.data(), kErrorDetails.size()));
  google::rpc::Status details;
  if (!payload.has_value() || !details.ParseFromString(std::string(*payload))) return message;
  for (const google::protobuf::Any& detail : details.details()) {
    google::rpc::BadRequest request;
    if (!detail.UnpackTo(&request)) continue;
    for (const auto& violation : request.field_violations()) {
      if (absl::StrContains(message, violation.description())) continue;
      absl::StrAppend(&message, "; ", violation.field(), ": ", violation.description());
    }
  }
  return message;
}

}  // namespace albtpu::client
