#include "service/client/server_source.h"

#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "absl/strings/str_cat.h"
#include "albtpu/v1/uncertainty_service.grpc.pb.h"
#include "service/client/channel.h"
#include "service/client/column_exchange.h"
#include "service/client/server_error.h"
#include "service/client/wire.h"

namespace albtpu::client {
namespace {

using albtpu::v1::UncertaintyService;

// Time limit of calls that a healthy server answers immediately.
constexpr std::chrono::seconds kDeadline{60};

// Connecting to an absent server fails within one second.
constexpr int kMostOpeningRetries = 3;

void SetDeadline(grpc::ClientContext& context) {
  context.set_deadline(std::chrono::system_clock::now() + kDeadline);
}

// Whether a retry may succeed: the server is unavailable or at its limit.
bool IsTransient(const absl::Status& status) {
  return absl::IsUnavailable(status) || absl::IsResourceExhausted(status);
}

// The channel notices that its server is back only while someone waits for it to connect.
void Pause(grpc::Channel& channel, std::chrono::milliseconds pause) {
  const auto until = std::chrono::system_clock::now() + pause;
  channel.GetState(true);
  channel.WaitForConnected(until);
  std::this_thread::sleep_until(until);
}

// Makes a call that precedes the first pulse, with a few retries: if one of several servers has just stopped, another
// one answers. `call(grpc::ClientContext&)` returns a grpc::Status.
template <typename Call>
absl::Status CallWithRetries(grpc::Channel& channel, const Patience& patience, Call call) {
  for (int retries = 0;; ++retries) {
    grpc::ClientContext context;
    SetDeadline(context);
    const absl::Status status = FromGrpc(call(context));
    if (!IsTransient(status) || retries == std::min(patience.retries, kMostOpeningRetries)) return status;
    Pause(channel, patience.first_pause * (1 << retries));
  }
}

absl::StatusOr<TableSummary> GetTable(const std::string& address,
                                      const std::shared_ptr<grpc::Channel>& channel, const Patience& patience,
                                      const std::string& table) {
  const auto stub = UncertaintyService::NewStub(channel);
  albtpu::v1::GetTableRequest request;
  request.set_table(table);
  albtpu::v1::GetTableResponse response;
  const absl::Status status = CallWithRetries(*channel, patience, [&](grpc::ClientContext& context) {
    return stub->GetTable(&context, request, &response);
  });
  if (!status.ok()) return WithServerAddress(status, address);
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
    const absl::Status status = QueryByStream(stub_, task, answered);
    if (status.ok()) break;
    if (answered > before) retries = 0;
    if (!IsTransient(status)) return WithServerAddress(status, address_);
    if (retries == patience_.retries) {
      const std::string message = absl::StrCat(status.message(), " (retried ", retries, " times after ",
                                               answered, " of ", pulses.size, " pulses)");
      return WithServerAddress(WithMessage(status, message), address_);
    }
    Pause(*channel_, patience_.first_pause * (1 << retries++));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::unique_ptr<UncertaintySource>> OpenServer(const std::string& address,
                                                              const std::string& table,
                                                              const Patience& patience,
                                                              const Credentials& credentials) {
  const absl::StatusOr<std::shared_ptr<grpc::Channel>> channel = OpenChannel(address, credentials);
  if (!channel.ok()) return channel.status();
  absl::StatusOr<TableSummary> summary = GetTable(address, *channel, patience, table);
  if (!summary.ok()) return summary.status();
  return std::make_unique<ServerSource>(address, *channel, *std::move(summary), patience);
}

absl::StatusOr<std::vector<TableSummary>> ListServerTables(const std::string& address,
                                                           const Credentials& credentials) {
  const absl::StatusOr<std::shared_ptr<grpc::Channel>> channel = OpenChannel(address, credentials);
  if (!channel.ok()) return channel.status();
  const auto stub = UncertaintyService::NewStub(*channel);
  albtpu::v1::ListTablesResponse response;
  const absl::Status status = CallWithRetries(
      **channel, {}, [&](grpc::ClientContext& context) { return stub->ListTables(&context, {}, &response); });
  if (!status.ok()) return WithServerAddress(status, address);
  std::vector<TableSummary> tables;
  for (const auto& listed : response.tables()) {
    absl::StatusOr<TableSummary> table = GetTable(address, *channel, {}, listed.reference().name());
    if (!table.ok()) return table.status();
    table->is_default = listed.reference().name() == response.default_table();
    tables.push_back(*std::move(table));
  }
  return tables;
}

}  // namespace albtpu::client
