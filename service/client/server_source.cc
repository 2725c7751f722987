#include "service/client/server_source.h"

#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

#include <chrono>
#include <thread>
#include <utility>

#include "absl/strings/str_cat.h"
#include "albtpu/v1/uncertainty_service.grpc.pb.h"
#include "service/client/column_exchange.h"
#include "service/client/wire.h"

namespace albtpu::client {
namespace {

using albtpu::v1::UncertaintyService;

// For what a healthy server answers at once.
constexpr std::chrono::seconds kDeadline{60};

void SetDeadline(grpc::ClientContext& context) {
  context.set_deadline(std::chrono::system_clock::now() + kDeadline);
}

absl::Status FromServer(const std::string& address, const absl::Status& status) {
  if (status.ok()) return status;
  std::string message = absl::StrCat("server ", address, ": ", status.message());
  if (absl::IsUnavailable(status)) {
    absl::StrAppend(&message, ": start albtpu-serve there, or name the HOST:PORT where it listens");
  }
  return absl::Status(status.code(), message);
}

absl::Status FromServer(const std::string& address, const grpc::Status& status) {
  // Both have the canonical numbers.
  const auto code = static_cast<absl::StatusCode>(status.error_code());
  return FromServer(address, absl::Status(code, status.error_message()));
}

// Whether the server may answer if asked again: it has gone, or is at its limit.
bool MayPass(const absl::Status& status) {
  return absl::IsUnavailable(status) || absl::IsResourceExhausted(status);
}

std::shared_ptr<grpc::Channel> Connect(const std::string& address) {
  grpc::ChannelArguments arguments;
  // Else gRPC waits a second and more before it looks again whether a server has come back.
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 1000);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

absl::StatusOr<TableSummary> GetTable(const std::string& address,
                                      const std::shared_ptr<grpc::Channel>& channel,
                                      const std::string& table) {
  grpc::ClientContext context;
  SetDeadline(context);
  albtpu::v1::GetTableRequest request;
  request.set_table(table);
  albtpu::v1::GetTableResponse response;
  absl::Status status =
      FromServer(address, UncertaintyService::NewStub(channel)->GetTable(&context, request, &response));
  if (!status.ok()) return status;
  return FromWire(response.table());
}

class ServerSource : public UncertaintySource {
 public:
  ServerSource(std::string address, const std::shared_ptr<grpc::Channel>& channel, TableSummary summary,
               const Patience& patience)
      : address_(std::move(address)),
        channel_(channel),
        stub_(channel),
        summary_(std::move(summary)),
        patience_(patience) {}

  const TableSummary& table() const override { return summary_; }
  absl::Status Answer(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers) override;

 private:
  // The channel sees that its server is back only while somebody waits for it.
  void Pause(std::chrono::milliseconds pause) {
    const auto until = std::chrono::system_clock::now() + pause;
    channel_->GetState(true);
    channel_->WaitForConnected(until);
    std::this_thread::sleep_until(until);
  }

  const std::string address_;
  const std::shared_ptr<grpc::Channel> channel_;
  grpc::GenericStub stub_;
  const TableSummary summary_;
  const Patience patience_;
};

absl::Status ServerSource::Answer(const Query& query, const PulseColumns& pulses,
                                  const AnswerColumns& answers) {
  if (absl::Status status = CheckLengths(pulses); !status.ok()) return status;
  const ColumnTask task{summary_.name, summary_.digest, query, pulses, answers};
  std::size_t answered = 0;
  int retries = 0;
  while (answered < pulses.size) {
    const std::size_t before = answered;
    const absl::Status status = Exchange(stub_, task, answered);
    if (status.ok()) break;
    if (answered > before) retries = 0;
    if (!MayPass(status)) return FromServer(address_, status);
    if (retries == patience_.retries) {
      return FromServer(
          address_, absl::Status(status.code(),
                                 absl::StrCat(status.message(), " (asked again ", retries, " times, after ",
                                              answered, " of ", pulses.size, " pulses)")));
    }
    Pause(patience_.first_pause * (1 << retries++));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::unique_ptr<UncertaintySource>> OpenServer(const std::string& address,
                                                              const std::string& table,
                                                              const Patience& patience) {
  const std::shared_ptr<grpc::Channel> channel = Connect(address);
  absl::StatusOr<TableSummary> summary = GetTable(address, channel, table);
  if (!summary.ok()) return summary.status();
  return std::make_unique<ServerSource>(address, channel, *std::move(summary), patience);
}

absl::StatusOr<std::vector<TableSummary>> ListServerTables(const std::string& address) {
  const std::shared_ptr<grpc::Channel> channel = Connect(address);
  grpc::ClientContext context;
  SetDeadline(context);
  albtpu::v1::ListTablesResponse response;
  absl::Status status =
      FromServer(address, UncertaintyService::NewStub(channel)->ListTables(&context, {}, &response));
  if (!status.ok()) return status;
  std::vector<TableSummary> tables;
  for (const auto& listed : response.tables()) {
    absl::StatusOr<TableSummary> table = GetTable(address, channel, listed.reference().name());
    if (!table.ok()) return table.status();
    table->is_default = listed.reference().name() == response.default_table();
    tables.push_back(*std::move(table));
  }
  return tables;
}

}  // namespace albtpu::client
