// Checks whether a server is healthy.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "service/client/credentials.h"

namespace albtpu::client {

// Calls grpc.health.v1 once. OK if the server as a whole is serving; otherwise the problem, within a few seconds.
absl::Status CheckHealth(const std::string& address, const Credentials& credentials = {});

}  // namespace albtpu::client
