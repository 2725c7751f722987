// Errors of a server, as ours.
#pragma once

#include <grpcpp/support/status.h>

#include <string_view>

#include "absl/status/status.h"

namespace albtpu::client {

// The type of the payload that holds the details of a server's error, a serialized google.rpc.Status.
inline constexpr std::string_view kErrorDetails = "type.googleapis.com/google.rpc.Status";

// The same code, message and details.
absl::Status FromGrpc(const grpc::Status& status);

// `status` with `message` in place of its own.
absl::Status WithMessage(const absl::Status& status, std::string_view message);

}  // namespace albtpu::client
