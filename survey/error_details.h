// What a server's error says about single fields of a request.
#pragma once

#include <string>

#include "absl/status/status.h"

namespace albtpu::client {

// The message of `status`, then what its details add: `; FIELD: DESCRIPTION` for each field violation
// (google.rpc.BadRequest) whose description the message does not have.
std::string MessageWithDetails(const absl::Status& status);

}  // namespace albtpu::client
