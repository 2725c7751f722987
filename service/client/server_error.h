// Errors of a server, as absl::Status.
#pragma once

#include <grpcpp/support/status.h>

#include <string>
#include <string_view>

#include "absl/status/status.h"

namespace albtpu::client {

// The type of the payload with the details of a server's error, a serialized google.rpc.Status.
inline constexpr std::string_view kErrorDetails = "type.googleapis.com/google.rpc.Status";

// The same code, message and details.
absl::Status FromGrpc(const grpc::Status& status);

// `status` with another message.
absl::Status WithMessage(const absl::Status& status, std::string_view message);

// `status` with the address in its message and, where one helps, a suggestion. An OK status stays as it is.
absl::Status WithServerAddress(const absl::Status& status, const std::string& address);

}  // namespace albtpu::client
