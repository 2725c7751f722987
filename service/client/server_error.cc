#include "service/client/server_error.h"

#include "absl/strings/cord.h"
#include "absl/strings/str_cat.h"

namespace albtpu::client {
namespace {

absl::string_view ToAbsl(std::string_view text) { return {text.data(), text.size()}; }

}  // namespace

absl::Status FromGrpc(const grpc::Status& status) {
  // gRPC and Abseil use the same numbers for the codes.
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

absl::Status WithServerAddress(const absl::Status& status, const std::string& address) {
  if (status.ok()) return status;
  std::string message = absl::StrCat("server ", address, ": ", status.message());
  if (absl::IsUnavailable(status)) {
    absl::StrAppend(
        &message,
        "; start albtpu-serve there, check HOST:PORT, or check whether the server speaks TLS (--tls-ca)");
  }
  if (absl::IsUnauthenticated(status)) absl::StrAppend(&message, "; check the token (--token-file)");
  return WithMessage(status, message);
}

}  // namespace albtpu::client
