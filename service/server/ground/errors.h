// Errors for callers: the fields of a request that are invalid, and the only place that makes gRPC statuses of errors.
#pragma once

#include <grpcpp/support/status.h>

#include <string_view>

#include "absl/status/status.h"
#include "google/rpc/error_details.pb.h"

namespace albtpu::server {

// All invalid fields of a request. They become the details of the error (google.rpc.BadRequest), for programs; the
// message is for people.
class FieldViolations {
 public:
  // `field` is a path in the request, such as `pulses.depth`. `description` says what is wrong and what would be
  // right, and names the field itself.
  void Add(std::string_view field, std::string_view description);

  // OK if no field was added. Otherwise INVALID_ARGUMENT: the description of the first field is the message, and all
  // fields are its details.
  absl::Status ToStatus() const;

 private:
  google::rpc::BadRequest request_;
};

// INVALID_ARGUMENT because of one field.
absl::Status FieldViolation(std::string_view field, std::string_view description);

// The same error for a request that is the field `outer` of another request: each field becomes `outer.FIELD`.
absl::Status Within(std::string_view outer, const absl::Status& status);

// Passes on code and message if the caller can correct the error, and those payloads of `status` whose type is a
// message as details: a google.rpc.Status in `grpc-status-details-bin`. Any other error is the server's own: its
// message, which may name files, goes to the log, and the caller gets INTERNAL without it. Messages are cut at
// kMaxErrorBytes.
grpc::Status ToGrpcStatus(const absl::Status& status);

}  // namespace albtpu::server
