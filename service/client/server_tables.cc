#include "service/client/server_tables.h"

#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "absl/strings/str_cat.h"
#include "albtpu/v1/uncertainty_service.grpc.pb.h"
#include "budget/query/query_check.h"
#include "service/client/budget_exchange.h"
#include "service/client/channel.h"
#include "service/client/column_exchange.h"
#include "service/client/wire.h"
#include "service/seas/sea_pulses.h"

namespace albtpu::client {
namespace {

using albtpu::v1::UncertaintyService;

// Time limit of calls that a healthy server answers immediately.
constexpr std::chrono::seconds kDeadline{60};

// Connecting to an absent server fails within one second.
constexpr int kMaxOpeningRetries = 3;

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

// Calls a method that precedes the first pulse.
template <typename Request, typename Response>
absl::StatusOr<Response> CallWithRetries(const ServerConnection& server,
                                         grpc::Status (UncertaintyService::Stub::*method)(grpc::ClientContext*,
                                                                                          const Request&, Response*),
                                         const Request& request) {
  const auto stub = UncertaintyService::NewStub(server.channel);
  for (int retries = 0;; ++retries) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kDeadline);
    Response response;
    const absl::Status status = FromGrpc(((*stub).*method)(&context, request, &response));
    if (status.ok()) return response;
    if (!IsTransient(status) || retries == std::min(server.patience.retries, kMaxOpeningRetries))
      return WithServerAddress(status, server.address);
    Pause(*server.channel, server.patience.first_pause * (1 << retries));
  }
}

class ServerSource final : public UncertaintySource {
 public:
  ServerSource(const ServerConnection& server, TableSummary table, std::unique_ptr<const albtpu::v1::SeaState> sea)
      : server_(server), stub_(server.channel), table_(std::move(table)), sea_(std::move(sea)) {}

  const TableSummary& table() const override { return table_; }
  absl::Status Answer(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers) override;
  absl::Status AnswerBudget(const BudgetOptions& options, const BudgetPulses& pulses,
                            const BudgetAnswers& answers) override;

 private:
  // Calls `exchange(answered)`, which answers pulses from `answered` on, until all are answered; with retries.
  template <typename Exchange>
  absl::Status AnswerAll(std::size_t size, const Exchange& exchange);

  const ServerConnection server_;
  grpc::GenericStub stub_;
  const TableSummary table_;
  const std::unique_ptr<const albtpu::v1::SeaState> sea_;
};

absl::Status ServerSource::Answer(const Query& query, const PulseColumns& all_pulses, const AnswerColumns& answers) {
  const PulseColumns pulses = table_.sea ? OnOneSea(all_pulses) : all_pulses;
  if (absl::Status status = CheckLengths(table_.sea ? kOneSea : kSeaSurface, pulses); !status.ok()) return status;
  const ColumnTask task{table_.name, table_.digest, sea_.get(), query, pulses, answers};
  return AnswerAll(pulses.size, [&](std::size_t& answered) { return QueryByStream(stub_, task, answered); });
}

absl::Status ServerSource::AnswerBudget(const BudgetOptions& options, const BudgetPulses& all_pulses,
                                        const BudgetAnswers& answers) {
  BudgetPulses pulses = all_pulses;
  if (table_.sea) pulses.pulses = OnOneSea(all_pulses.pulses);
  if (absl::Status status = CheckQuery(table_.sea ? kOneSea : kSeaSurface, pulses, options); !status.ok())
    return status;
  const BudgetTask task{table_.name, table_.digest, sea_.get(), options, pulses, answers};
  return AnswerAll(pulses.pulses.size, [&](std::size_t& answered) { return QueryByCalls(stub_, task, answered); });
}

template <typename Exchange>
absl::Status ServerSource::AnswerAll(std::size_t size, const Exchange& exchange) {
  const Patience& patience = server_.patience;
  std::size_t answered = 0;
  int retries = 0;
  while (answered < size) {
    const std::size_t before = answered;
    const absl::Status status = exchange(answered);
    if (status.ok()) break;
    if (answered > before) retries = 0;
    if (!IsTransient(status)) return WithServerAddress(status, server_.address);
    if (retries == patience.retries) {
      const std::string message =
          absl::StrCat(status.message(), " (retried ", retries, " times after ", answered, " of ", size, " pulses)");
      return WithServerAddress(WithMessage(status, message), server_.address);
    }
    Pause(*server_.channel, patience.first_pause * (1 << retries++));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<albtpu::v1::ListTablesResponse> ListTables(const ServerConnection& server) {
  return CallWithRetries(server, &UncertaintyService::Stub::ListTables, albtpu::v1::ListTablesRequest());
}

absl::StatusOr<TableSummary> GetTable(const ServerConnection& server, const std::string& table) {
  albtpu::v1::GetTableRequest request;
  request.set_table(table);
  const auto response = CallWithRetries(server, &UncertaintyService::Stub::GetTable, request);
  if (!response.ok()) return response.status();
  return FromWire(response->table());
}

absl::StatusOr<TableSummary> CompileSea(const ServerConnection& server, const albtpu::v1::SeaState& sea) {
  albtpu::v1::CompileSeaRequest request;
  *request.mutable_sea() = sea;
  const auto response = CallWithRetries(server, &UncertaintyService::Stub::CompileSea, request);
  if (!response.ok()) return response.status();
  return FromWire(response->table());
}

std::unique_ptr<UncertaintySource> MakeServerSource(const ServerConnection& server, TableSummary table,
                                                    std::unique_ptr<const albtpu::v1::SeaState> sea) {
  return std::make_unique<ServerSource>(server, std::move(table), std::move(sea));
}

}  // namespace albtpu::client
