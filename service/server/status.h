// The one place where our errors become those of gRPC.
#pragma once

#include <grpcpp/support/status.h>

#include "absl/status/status.h"

namespace albtpu::server {

// The same code and message where the error is the caller's to mend. Any other error is the server's own: its
// message, which may name files, goes to the log, and the caller learns only that it happened.
grpc::Status ToGrpcStatus(const absl::Status& status);

}  // namespace albtpu::server
