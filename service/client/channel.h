// A way to the servers of an address.
#pragma once

#include <grpcpp/channel.h>

#include <memory>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "service/client/credentials.h"

namespace albtpu::client {

// `address` is HOST:PORT, or what else gRPC resolves: `dns:///NAME:PORT`, `ipv4:HOST:PORT,HOST:PORT`. Where it
// has several addresses, calls take turns with all that answer; one that is gone is left out until it is back.
// Nothing is sent yet. Fails for files of credentials that are not right.
absl::StatusOr<std::shared_ptr<grpc::Channel>> OpenChannel(const std::string& address,
                                                           const Credentials& credentials);

// `status` with the address, and with what would be right.
absl::Status FromServer(const std::string& address, const absl::Status& status);

}  // namespace albtpu::client
