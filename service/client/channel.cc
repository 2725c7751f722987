#include "service/client/channel.h"

#include <grpcpp/client_context.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/support/channel_arguments.h>

#include <chrono>

#include "absl/strings/ascii.h"
#include "absl/strings/cord.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "grpc/health/v1/health.grpc.pb.h"
#include "service/client/proxy.h"
#include "service/openssl_at_exit.h"
#include "service/text_file.h"
#include "status/status_macros.h"

namespace albtpu::client {
namespace {

[[maybe_unused]] const bool kOpenSslIsKept = KeepOpenSslAtExit();

// A server whose machine or network has failed stays silent. After this much silence the client pings it, and gives
// it up if it does not respond within the timeout. The server allows a ping every 10 s. The timeout also bounds how
// long the system keeps trying to send; without it, a call that has been given up would end only after a quarter of
// an hour.
constexpr int kKeepaliveTimeMs = 20'000;
constexpr int kKeepaliveTimeoutMs = 10'000;

// By default gRPC waits a second and more before it tries to reconnect to a server.
constexpr int kFirstReconnectMs = 100;
constexpr int kLongestReconnectMs = 1000;

// Time limit of one attempt to connect to a machine that does not respond; the default is 20 s.
constexpr int kConnectMs = 5000;

// The ends of the first lines, before the hyphens, of PEM files of each kind.
constexpr char kCertificate[] = "CERTIFICATE", kPrivateKey[] = "PRIVATE KEY";

// Empty if there is no path.
absl::StatusOr<std::string> ReadPem(const std::string& flag, const std::string& path, const std::string& kind) {
  if (path.empty()) return "";
  absl::StatusOr<std::string> pem = ReadTextFile(flag, path);
  if (!pem.ok() || absl::StrContains(*pem, kind + "-----")) return pem;
  return absl::InvalidArgumentError(absl::StrCat(flag, ": ", path, " has no ", kind, "; give a PEM file that has one"));
}

absl::StatusOr<std::string> ReadToken(const std::string& path) {
  absl::StatusOr<std::string> text = ReadTextFile("--token-file", path);
  if (!text.ok()) return text;
  const absl::string_view token = absl::StripAsciiWhitespace(*text);
  const bool is_one = !token.empty() && token.find_first_of(" \t\r\n") == absl::string_view::npos;
  if (is_one) return std::string(token);
  return absl::InvalidArgumentError(absl::StrCat("--token-file: ", path, " has ",
                                                 token.empty() ? "no" : "more than one",
                                                 " token; give a file with one token and nothing else"));
}

}  // namespace

absl::StatusOr<std::shared_ptr<grpc::ChannelCredentials>> MakeCredentials(const Credentials& credentials) {
  if (!credentials.HasTls()) return grpc::InsecureChannelCredentials();
  if (credentials.certificate.empty() != credentials.key.empty())
    return absl::InvalidArgumentError("--tls-cert and --tls-key: one is missing; give both or neither");
  ASSIGN_OR_RETURN(std::string ca, ReadPem("--tls-ca", credentials.ca, kCertificate));
  ASSIGN_OR_RETURN(std::string key, ReadPem("--tls-key", credentials.key, kPrivateKey));
  ASSIGN_OR_RETURN(std::string certificate, ReadPem("--tls-cert", credentials.certificate, kCertificate));
  const auto tls = grpc::SslCredentials({std::move(ca), std::move(key), std::move(certificate)});
  if (credentials.token.empty()) return tls;
  ASSIGN_OR_RETURN(std::string token, ReadToken(credentials.token));
  return grpc::CompositeChannelCredentials(tls, grpc::AccessTokenCredentials(token));
}

absl::StatusOr<std::shared_ptr<grpc::Channel>> OpenChannel(const std::string& address, const Credentials& credentials) {
  ASSIGN_OR_RETURN(const auto channel_credentials, MakeCredentials(credentials));
  grpc::ChannelArguments arguments;
  arguments.SetLoadBalancingPolicyName("round_robin");
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);  // ServerSource retries; gRPC would only by a service config.
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, kKeepaliveTimeMs);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kKeepaliveTimeoutMs);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, kFirstReconnectMs);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, kLongestReconnectMs);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, kConnectMs);
  if (!ProxyFor(address).has_value()) arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  return grpc::CreateCustomChannel(address, channel_credentials, arguments);
}

namespace {

using grpc::health::v1::Health;
using grpc::health::v1::HealthCheckResponse;

// Monitoring systems do not wait longer for a health check.
constexpr std::chrono::seconds kHealthDeadline{4};

absl::string_view ToAbsl(std::string_view text) { return {text.data(), text.size()}; }

}  // namespace

absl::Status CheckHealth(const std::string& address, const Credentials& credentials) {
  ASSIGN_OR_RETURN(const auto channel, OpenChannel(address, credentials));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kHealthDeadline);
  HealthCheckResponse response;
  const absl::Status status = FromGrpc(Health::NewStub(channel)->Check(&context, {}, &response));
  if (!status.ok()) return WithServerAddress(status, address);
  if (response.status() == HealthCheckResponse::SERVING) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrCat("server ", address, ": ",
                                                    HealthCheckResponse::ServingStatus_Name(response.status()),
                                                    " (it is about to stop); use another server, or start it again"));
}

absl::Status FromGrpc(const grpc::Status& status) {
  // gRPC and Abseil use the same numbers for the codes.
  absl::Status same(static_cast<absl::StatusCode>(status.error_code()), status.error_message());
  if (!status.error_details().empty()) same.SetPayload(ToAbsl(kErrorDetails), absl::Cord(status.error_details()));
  return same;
}

absl::Status WithMessage(const absl::Status& status, std::string_view message) {
  absl::Status other(status.code(), ToAbsl(message));
  status.ForEachPayload(
      [&other](absl::string_view type, const absl::Cord& payload) { other.SetPayload(type, payload); });
  return other;
}

absl::Status WithServerAddress(const absl::Status& status, const std::string& address) {
  if (status.ok()) return status;
  std::string message = absl::StrCat("server ", address, ProxyText(address), ": ", status.message());
  if (absl::IsUnavailable(status)) {
    absl::StrAppend(&message,
                    "; start albtpu-serve there, check HOST:PORT, or check whether the server speaks TLS (--tls-ca)");
  }
  if (absl::IsUnauthenticated(status)) absl::StrAppend(&message, "; check the token (--token-file)");
  return WithMessage(status, message);
}

}  // namespace albtpu::client
