#include "service/client/grpc_error.h"

#include "absl/strings/cord.h"

namespace albtpu::client {
namespace {

absl::string_view ToAbsl(std::string_view text) { return {text.data(), text.size()}; }

}  // namespace

absl::Status FromGrpc(const grpc::Status& status) {
  // Both have the canonical numbers.
  absl::Status same(static_cast<absl::StatusCode>(status.error_code()), status.error_message());
  if (!status.error_details().empty()) {
    same.SetPayload(ToAbsl(kErrorDetails), absl::Cord(status.error_details()));
  }
  return same;
}

absl::Status WithMessage(const absl::Status& status, std::string_view message) {
  absl::Status other(status.code(), ToAbsl(message));
  status.ForEachPayload(
      [&other](absl::string_view type, const absl::Cord& payload) { other.SetPayload(type, payload); });
  return other;
}

}  // namespace albtpu::client
