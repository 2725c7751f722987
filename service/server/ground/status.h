// The one place where our errors become those of gRPC.
#pragma once

#include <grpcpp/support/status.h>

#include "absl/status/status.h"

namespace albtpu::server {

// The same code and message where the error is the caller's to mend, with the payloads of `status` whose type
// is a message (field_violations.h) as details: a google.rpc.Status in `grpc-status-details-bin`. Any other
// error is the server's own: its message, which may name files, goes to the log, and the caller learns only
// that it happened. Messages are cut at kMaxErrorBytes.
grpc::Status ToGrpcStatus(const absl::Status& status);

}  // namespace albtpu::server
