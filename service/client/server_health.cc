#include "service/client/server_health.h"

#include <grpcpp/client_context.h>

#include <chrono>

#include "absl/strings/str_cat.h"
#include "grpc/health/v1/health.grpc.pb.h"
#include "service/client/channel.h"
#include "service/client/server_error.h"

namespace albtpu::client {
namespace {

using grpc::health::v1::Health;
using grpc::health::v1::HealthCheckResponse;

// Monitoring systems do not wait longer for a health check.
constexpr std::chrono::seconds kDeadline{4};

}  // namespace

absl::Status CheckHealth(const std::string& address, const Credentials& credentials) {
  const auto channel = OpenChannel(address, credentials);
  if (!channel.ok()) return channel.status();
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kDeadline);
  HealthCheckResponse response;
  const absl::Status status = FromGrpc(Health::NewStub(*channel)->Check(&context, {}, &response));
  if (!status.ok()) return WithServerAddress(status, address);
  if (response.status() == HealthCheckResponse::SERVING) return absl::OkStatus();
  return absl::FailedPreconditionError(
      absl::StrCat("server ", address, ": ", HealthCheckResponse::ServingStatus_Name(response.status()),
                   " (it is about to stop); use another server, or start it again"));
}

}  // namespace albtpu::client
