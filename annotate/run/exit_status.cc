#include "annotate/run/exit_status.h"

#include <cstdio>

#include "absl/strings/cord.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "service/client/server_error.h"
#include "service/printable_text.h"

namespace albtpu::annotate {

std::string MessageWithDetails(const absl::Status& status) {
  std::string message(status.message());
  const auto payload =
      status.GetPayload(absl::string_view(client::kErrorDetails.data(), client::kErrorDetails.size()));
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

int Report(const absl::Status& status) {
  if (status.ok()) return 0;
  Note(MessageWithDetails(status));
  return formats::IsUsageError(status) ? formats::kExitUsage : formats::kExitFailure;
}

void Note(std::string_view message, const std::string& below) {
  std::fprintf(stderr, "albtpu-query: %s%s\n", PrintableText(message).c_str(), below.c_str());
}

}  // namespace albtpu::annotate
