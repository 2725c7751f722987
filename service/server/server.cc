#include "service/server/server.h"

#include <grpc/support/log.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <spdlog/spdlog.h>

#include <chrono>

#include "absl/strings/str_cat.h"
#include "service/server/limits.h"

namespace albtpu::server {
namespace {

// What gRPC says while it tries to listen is said better, and once, by the error of Start.
void Discard(gpr_log_func_args* /*message*/) {}

void LogAsOurs(gpr_log_func_args* message) {
  const bool is_error = message->severity == GPR_LOG_SEVERITY_ERROR;
  spdlog::log(is_error ? spdlog::level::warn : spdlog::level::debug, "gRPC: {}", message->message);
}

void Configure(grpc::ServerBuilder& builder) {
  builder.SetMaxReceiveMessageSize(static_cast<int>(kMaxMessageBytes));
  builder.SetMaxSendMessageSize(static_cast<int>(kMaxMessageBytes));
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, kMaxCallsPerConnection);
  // Else two servers share a port and nobody notices.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
}

}  // namespace

Server::Server(const TableCatalog& catalog)
    : service_(catalog), health_(v1::UncertaintyService::service_full_name()) {}

absl::StatusOr<std::unique_ptr<Server>> Server::Start(const TableCatalog& catalog,
                                                      const ListenAddress& address) {
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  std::unique_ptr<Server> server(new Server(catalog));
  grpc::ServerBuilder builder;
  Configure(builder);
  builder.RegisterService(&server->service_);
  builder.RegisterService(&server->health_);
  int port = 0;
  builder.AddListeningPort(address.ToString(), grpc::InsecureServerCredentials(), &port);
  gpr_set_log_function(Discard);
  server->server_ = builder.BuildAndStart();
  gpr_set_log_function(LogAsOurs);
  if (server->server_ == nullptr || port == 0) {
    const absl::Status reason = address.Probe();
    return absl::UnavailableError(absl::StrCat(
        "cannot listen on ", reason.ok() ? absl::string_view(address.ToString()) : reason.message()));
  }
  server->address_ = address.WithPort(port);
  return server;
}

void Server::Drain() {
  health_.StopServing();
  server_->Shutdown(std::chrono::system_clock::now() + kDrainTime);
  server_->Wait();
}

}  // namespace albtpu::server
