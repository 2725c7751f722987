#include "service/client/channel.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/support/channel_arguments.h>

#include "absl/strings/str_cat.h"
#include "service/client/channel_credentials.h"
#include "service/client/grpc_error.h"

namespace albtpu::client {
namespace {

// A server whose machine or network has gone says nothing: it is asked for a sign of life after so long a
// silence, and given up without one. The server allows it every 10 s. This also bounds how long the system
// tries to send: else a call that is given up ends only then, after a quarter of an hour.
constexpr int kKeepaliveTimeMs = 20'000;
constexpr int kKeepaliveTimeoutMs = 10'000;

// Else gRPC waits a second and more before it looks again whether a server has come back.
constexpr int kFirstReconnectMs = 100;
constexpr int kLongestReconnectMs = 1000;

// How long one try to reach a machine that says nothing may take; else 20 s.
constexpr int kConnectMs = 5000;

}  // namespace

absl::StatusOr<std::shared_ptr<grpc::Channel>> OpenChannel(const std::string& address,
                                                           const Credentials& credentials) {
  const auto channel_credentials = MakeCredentials(credentials);
  if (!channel_credentials.ok()) return channel_credentials.status();
  grpc::ChannelArguments arguments;
  arguments.SetLoadBalancingPolicyName("round_robin");
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);  // We ask again ourselves; of gRPC's no policy says so.
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, kKeepaliveTimeMs);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kKeepaliveTimeoutMs);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, kFirstReconnectMs);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, kLongestReconnectMs);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, kConnectMs);
  return grpc::CreateCustomChannel(address, *channel_credentials, arguments);
}

absl::Status FromServer(const std::string& address, const absl::Status& status) {
  if (status.ok()) return status;
  std::string message = absl::StrCat("server ", address, ": ", status.message());
  if (absl::IsUnavailable(status)) {
    absl::StrAppend(
        &message,
        ": start albtpu-serve there, name the HOST:PORT where it listens, or see that it speaks TLS "
        "if you do (--tls-ca)");
  }
  if (absl::IsUnauthenticated(status)) absl::StrAppend(&message, " (--token-file)");
  return WithMessage(status, message);
}

}  // namespace albtpu::client
