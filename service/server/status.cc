#include "service/server/status.h"

#include <spdlog/spdlog.h>

#include <string>

namespace albtpu::server {

grpc::Status ToGrpcStatus(const absl::Status& status) {
  switch (status.code()) {
    case absl::StatusCode::kOk:
      return grpc::Status::OK;
    case absl::StatusCode::kInvalidArgument:
    case absl::StatusCode::kNotFound:
    case absl::StatusCode::kFailedPrecondition:
    case absl::StatusCode::kCancelled:  // By the caller, or by its deadline.
      // The numbers of the codes are the same by definition.
      return grpc::Status(static_cast<grpc::StatusCode>(status.code()), std::string(status.message()));
    default:
      spdlog::error("call failed: {}", status.ToString());
      return grpc::Status(grpc::StatusCode::INTERNAL, "internal error: the log of the server says more");
  }
}

}  // namespace albtpu::server
