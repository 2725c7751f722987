// Whether a server is well.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "service/client/credentials.h"

namespace albtpu::client {

// Asks grpc.health.v1 once. OK if the server as a whole serves; else what is wrong, after some seconds at most.
absl::Status CheckHealth(const std::string& address, const Credentials& credentials = {});

}  // namespace albtpu::client
