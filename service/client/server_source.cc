#include "service/client/server_source.h"

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
#include "service/client/local_source.h"
#include "service/client/sea_sources.h"
#include "service/client/wire.h"
#include "service/seas/sea_summary.h"
#include "status/status_macros.h"

namespace albtpu::client {
namespace {

using albtpu::v1::UncertaintyService;

// Time limit of calls that a healthy server answers immediately.
constexpr std::chrono::seconds kCallDeadline{60};

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

struct ServerConnection {
  std::string address;  // For messages.
  std::shared_ptr<grpc::Channel> channel;
  Patience patience;
};

absl::StatusOr<ServerConnection> Connect(const std::string& address, const Patience& patience,
                                         const Credentials& credentials) {
  ASSIGN_OR_RETURN(std::shared_ptr<grpc::Channel> channel, OpenChannel(address, credentials));
  return ServerConnection{address, std::move(channel), patience};
}

// Calls a method that precedes the first pulse, with a few retries: if one of several servers has just stopped, another
// one answers. Errors name the address.
template <typename Request, typename Response>
absl::StatusOr<Response> CallWithRetries(const ServerConnection& server,
                                         grpc::Status (UncertaintyService::Stub::*method)(grpc::ClientContext*,
                                                                                          const Request&, Response*),
                                         const Request& request) {
  const auto stub = UncertaintyService::NewStub(server.channel);
  for (int retries = 0;; ++retries) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kCallDeadline);
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
  // The table is that of `sea`, or one of the server's if `sea` is null.
  ServerSource(ServerConnection server, TableSummary table, std::unique_ptr<const albtpu::v1::SeaState> sea = nullptr)
      : server_(std::move(server)), stub_(server_.channel), table_(std::move(table)), sea_(std::move(sea)) {}

  const TableSummary& table() const override { return table_; }

  absl::Status Answer(const Query& query, const PulseColumns& all_pulses, const AnswerColumns& answers) override {
    const PulseColumns pulses = table_.sea ? OnOneSea(all_pulses) : all_pulses;
    RETURN_IF_ERROR(CheckLengths(table_.sea ? kOneSea : kSeaSurface, pulses));
    const ColumnTask task{table_.name, table_.digest, sea_.get(), table_.refractive_index, query, pulses, answers};
    return AnswerAll(pulses.size, [&](std::size_t& answered) { return QueryByStream(stub_, task, answered); });
  }

  absl::Status AnswerBudget(const BudgetOptions& options, const BudgetPulses& all_pulses,
                            const BudgetAnswers& answers) override {
    return AskBudget(options, nullptr, all_pulses, answers, nullptr);
  }

  absl::Status AnswerBudgetInWater(const BudgetOptions& options, const KnownWater& water, const BudgetPulses& pulses,
                                   const BudgetAnswers& answers, WaterSummary* summary) override {
    RETURN_IF_ERROR(CheckWater(water));
    const albtpu::v1::WaterState state = ToWire(water);
    return AskBudget(options, &state, pulses, answers, summary);
  }

 private:
  absl::Status AskBudget(const BudgetOptions& options, const albtpu::v1::WaterState* water,
                         const BudgetPulses& all_pulses, const BudgetAnswers& answers, WaterSummary* summary) {
    BudgetPulses pulses = all_pulses;
    if (table_.sea) pulses.pulses = OnOneSea(all_pulses.pulses);
    RETURN_IF_ERROR(CheckQuery(table_.sea ? kOneSea : kSeaSurface, pulses, options));
    RETURN_IF_ERROR(CheckIndex(options, table_));
    const BudgetTask task{
        {table_.name, table_.digest, sea_.get(), table_.refractive_index, options, pulses, answers}, water, summary};
    return AnswerAll(pulses.pulses.size, [&](std::size_t& answered) { return QueryByCalls(stub_, task, answered); });
  }

  // Calls `exchange(answered)`, which answers pulses from `answered` on, until all are answered; with retries.
  template <typename Exchange>
  absl::Status AnswerAll(std::size_t size, const Exchange& exchange) {
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

  const ServerConnection server_;
  grpc::GenericStub stub_;
  const TableSummary table_;
  const std::unique_ptr<const albtpu::v1::SeaState> sea_;
};

absl::StatusOr<TableSummary> GetTable(const ServerConnection& server, const std::string& table) {
  albtpu::v1::GetTableRequest request;
  request.set_table(table);
  ASSIGN_OR_RETURN(const auto response, CallWithRetries(server, &UncertaintyService::Stub::GetTable, request));
  return FromWire(response.table());
}

class ServerSeaSources final : public SeaSources {
 public:
  ServerSeaSources(ServerConnection server, double index) : server_(std::move(server)), index_(index) {}

  absl::StatusOr<std::unique_ptr<UncertaintySource>> Open(const KnownSea& sea) override {
    albtpu::v1::CompileSeaRequest request;
    *request.mutable_sea() = ToWire(sea);
    request.set_refractive_index(index_);
    ASSIGN_OR_RETURN(const auto response, CallWithRetries(server_, &UncertaintyService::Stub::CompileSea, request));
    TableSummary table = FromWire(response.table());
    table.refractive_index = index_;
    return std::make_unique<ServerSource>(
        server_, std::move(table), std::make_unique<const albtpu::v1::SeaState>(std::move(*request.mutable_sea())));
  }

 private:
  const ServerConnection server_;
  const double index_;
};

}  // namespace

absl::StatusOr<std::unique_ptr<UncertaintySource>> OpenServer(const std::string& address, const std::string& table,
                                                              const Patience& patience, const Credentials& credentials,
                                                              double index) {
  ASSIGN_OR_RETURN(const ServerConnection server, Connect(address, patience, credentials));
  ASSIGN_OR_RETURN(TableSummary summary, GetTable(server, table));
  summary.refractive_index = index;
  return std::make_unique<ServerSource>(server, std::move(summary));
}

absl::StatusOr<std::vector<TableSummary>> ListServerTables(const std::string& address, const Credentials& credentials) {
  ASSIGN_OR_RETURN(const ServerConnection server, Connect(address, {}, credentials));
  ASSIGN_OR_RETURN(const auto response,
                   CallWithRetries(server, &UncertaintyService::Stub::ListTables, albtpu::v1::ListTablesRequest()));
  std::vector<TableSummary> tables;
  for (const auto& listed : response.tables()) {
    ASSIGN_OR_RETURN(TableSummary table, GetTable(server, listed.reference().name()));
    table.is_default = listed.reference().name() == response.default_table();
    tables.push_back(std::move(table));
  }
  return tables;
}

absl::StatusOr<std::unique_ptr<SeaSources>> ServerSeas(const std::string& address, const Patience& patience,
                                                       const Credentials& credentials, double index) {
  ASSIGN_OR_RETURN(ServerConnection server, Connect(address, patience, credentials));
  return std::make_unique<ServerSeaSources>(std::move(server), index);
}

}  // namespace albtpu::client
