// A gRPC channel to the servers of an address, the health of a server, and its errors.
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/status.h>

#include <memory>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "service/client/credentials.h"

namespace albtpu::client {

// Reads the files of `credentials`. Fails for a file that cannot be read or is of another kind, and names its flag.
absl::StatusOr<std::shared_ptr<grpc::ChannelCredentials>> MakeCredentials(const Credentials& credentials);

// `address` is HOST:PORT or another form that gRPC resolves: `dns:///NAME:PORT`, `ipv4:HOST:PORT,HOST:PORT`. If it has
// several addresses, calls take turns with all servers that answer; a server that has failed is left out until it is
// back. Nothing is sent yet. Fails when MakeCredentials does.
absl::StatusOr<std::shared_ptr<grpc::Channel>> OpenChannel(const std::string& address, const Credentials& credentials);

// Checks whether a server is healthy.

// Calls grpc.health.v1 once. OK if the server as a whole is serving; otherwise the problem, within a few seconds.
absl::Status CheckHealth(const std::string& address, const Credentials& credentials = {});

// Errors of a server, as absl::Status.

// The type of the payload with the details of a server's error, a serialized google.rpc.Status.
inline constexpr std::string_view kErrorDetails = "type.googleapis.com/google.rpc.Status";

// The same code, message and details.
absl::Status FromGrpc(const grpc::Status& status);

// `status` with another message.
absl::Status WithMessage(const absl::Status& status, std::string_view message);

// `status` with the address in its message and, where one helps, a suggestion. An OK status stays as it is.
absl::Status WithServerAddress(const absl::Status& status, const std::string& address);

}  // namespace albtpu::client
