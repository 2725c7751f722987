#include "service/server/server.h"

#include <google/protobuf/stubs/logging.h>
#include <grpc/support/log.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"

namespace albtpu::server {
namespace {

// Writes what a library reports to our log. Anyone who reaches the port can cause it, so it is limited like lines about
// calls.
void LogOfLibrary(const char* library, const std::string& message) {
  static CallLog log;
  log.Write(spdlog::level::warn, absl::StrCat(library, ": ", message), LogFields::object());
}

void LogGrpcMessage(gpr_log_func_args* message) {
  if (message->severity == GPR_LOG_SEVERITY_ERROR) LogOfLibrary("gRPC", message->message);
}

void LogProtobufMessage(google::protobuf::LogLevel, const char*, int, const std::string& message) {
  LogOfLibrary("Protobuf", message);
}

int Milliseconds(std::chrono::milliseconds time) { return static_cast<int>(time.count()); }

void LimitConnections(grpc::ServerBuilder& builder) {
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, kMaxCallsPerConnection);
  builder.AddChannelArgument(GRPC_ARG_ENABLE_CHANNELZ, 1);  // Counts the calls of each connection.
  builder.AddChannelArgument(GRPC_ARG_MAX_METADATA_SIZE, kMaxMetadataBytes);
  builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, Milliseconds(kMaxHandshake));
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_IDLE_MS, Milliseconds(kMaxConnectionIdle));
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_AGE_MS, Milliseconds(kMaxConnectionAge));
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_AGE_GRACE_MS, Milliseconds(kMaxCallTime));
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, Milliseconds(kKeepaliveTime));
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, Milliseconds(kKeepaliveTimeout));
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, Milliseconds(kMinPingInterval));
  builder.AddChannelArgument(GRPC_ARG_TCP_MAX_READ_CHUNK_SIZE, kMaxReadBytes);
  grpc::ResourceQuota quota("connections");
  quota.Resize(kMaxConnectionBytes);
  quota.SetMaxThreads(kReflectionThreads);
  builder.SetResourceQuota(quota);
}

void Configure(grpc::ServerBuilder& builder) {
  builder.SetMaxReceiveMessageSize(static_cast<int>(kMaxMessageBytes));
  builder.SetMaxSendMessageSize(static_cast<int>(kMaxMessageBytes));
  LimitConnections(builder);
  // gRPC decompresses a message before it checks its size: some kilobytes could become gigabytes.
  builder.SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_GZIP, false);
  builder.SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_DEFLATE, false);
  builder.AddChannelArgument(GRPC_ARG_ENABLE_PER_MESSAGE_DECOMPRESSION, 0);
}

}  // namespace

Server::Server(LiveTables& tables, const Recorders& recorders, Access access, std::chrono::seconds max_stream_idle)
    : credentials_(std::move(access.credentials)),
      recorders_(recorders),
      service_(tables, recorders_, max_stream_idle),
      admin_(tables, recorders_, access.admin),
      health_({v1::UncertaintyService::service_full_name(), v1::AdminService::service_full_name()}) {}

absl::StatusOr<std::unique_ptr<Server>> Server::Start(LiveTables& tables, const Recorders& recorders,
                                                      const ListenAddress& address, Access access,
                                                      std::chrono::seconds max_stream_idle) {
  absl::StatusOr<std::vector<ListeningSocket>> sockets = Listen(address);
  if (!sockets.ok()) return absl::UnavailableError(absl::StrCat("cannot listen on ", sockets.status().message()));
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  std::unique_ptr<Server> server(new Server(tables, recorders, std::move(access), max_stream_idle));
  grpc::ServerBuilder builder;
  Configure(builder);
  builder.RegisterService(&server->service_);
  builder.RegisterService(&server->admin_);
  builder.RegisterService(&server->health_);
  auto acceptor = builder.experimental().AddExternalConnectionAcceptor(
      grpc::ServerBuilder::experimental_type::ExternalConnectionType::FROM_FD, server->credentials_);
  gpr_set_log_function(LogGrpcMessage);
  google::protobuf::SetLogHandler(LogProtobufMessage);
  server->server_ = builder.BuildAndStart();
  if (server->server_ == nullptr) return absl::InternalError("gRPC cannot start");
  server->address_ = address.WithPort(sockets->front().port());
  server->gate_ = std::make_unique<ConnectionGate>(*std::move(sockets), std::move(acceptor), recorders.access);
  server->watch_ =
      std::make_unique<ConnectionWatch>([gate = server->gate_.get(), recorders](const std::vector<Caller>& callers) {
        for (const Caller& caller : gate->Disconnect(callers)) {
          recorders.access.CountEndedConnection();
          recorders.log.Write(spdlog::level::warn, "connection closed (it had too many calls in memory)",
                              {{"peer", ToText(caller)}});
        }
      });
  return server;
}

void Server::Drain() {
  health_.StopServing();
  service_.Drain();
  watch_.reset();
  gate_.reset();
  server_->Shutdown(std::chrono::system_clock::now() + kDrainTime);
  server_->Wait();
}

}  // namespace albtpu::server
