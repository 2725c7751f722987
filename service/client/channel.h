// A gRPC channel to the servers of an address.
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/security/credentials.h>

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "service/client/credentials.h"

namespace albtpu::client {

// Reads the files of `credentials`. Fails for a file that cannot be read or is of another kind, and names its flag.
absl::StatusOr<std::shared_ptr<grpc::ChannelCredentials>> MakeCredentials(const Credentials& credentials);

// `address` is HOST:PORT or another form that gRPC resolves: `dns:///NAME:PORT`, `ipv4:HOST:PORT,HOST:PORT`. If it has
// several addresses, calls take turns with all servers that answer; a server that has failed is left out until it is
// back. Nothing is sent yet. Fails when MakeCredentials does.
absl::StatusOr<std::shared_ptr<grpc::Channel>> OpenChannel(const std::string& address,
                                                           const Credentials& credentials);

}  // namespace albtpu::client
