// Credentials as gRPC takes them.
#pragma once

#include <grpcpp/security/credentials.h>

#include <memory>

#include "absl/status/statusor.h"
#include "service/client/credentials.h"

namespace albtpu::client {

// Reads the files. Fails, with the flag that names it, for one that cannot be read or is not of its kind.
absl::StatusOr<std::shared_ptr<grpc::ChannelCredentials>> MakeCredentials(const Credentials& credentials);

}  // namespace albtpu::client
