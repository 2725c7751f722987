#include "service/client/server_source.h"

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "absl/strings/str_cat.h"
#include "service/client/wire.h"

namespace albtpu::client {
namespace {

// The most pulses of a message, by uncertainty_service.proto.
constexpr std::size_t kMostPulses = 65536;

// A batch is answered within a second by a healthy server; this is for one that is not.
constexpr std::chrono::seconds kDeadline{60};

void SetDeadline(grpc::ClientContext& context) {
  context.set_deadline(std::chrono::system_clock::now() + kDeadline);
}

absl::Status FromServer(const std::string& address, const grpc::Status& status) {
  if (status.ok()) return absl::OkStatus();
  const auto code = static_cast<absl::StatusCode>(status.error_code());  // Both have the canonical numbers.
  std::string message = absl::StrCat("server ", address, ": ", status.error_message());
  if (code == absl::StatusCode::kUnavailable) {
    absl::StrAppend(&message, ": start albtpu-serve there, or name the HOST:PORT where it listens");
  }
  return absl::Status(code, message);
}

std::unique_ptr<albtpu::v1::UncertaintyService::Stub> Connect(const std::string& address) {
  return albtpu::v1::UncertaintyService::NewStub(
      grpc::CreateChannel(address, grpc::InsecureChannelCredentials()));
}

absl::StatusOr<TableSummary> GetTable(const std::string& address,
                                      albtpu::v1::UncertaintyService::StubInterface& stub,
                                      const std::string& table) {
  grpc::ClientContext context;
  SetDeadline(context);
  albtpu::v1::GetTableRequest request;
  request.set_table(table);
  albtpu::v1::GetTableResponse response;
  absl::Status status = FromServer(address, stub.GetTable(&context, request, &response));
  if (!status.ok()) return status;
  return FromWire(response.table());
}

PulseColumns Slice(const PulseColumns& pulses, std::size_t begin, std::size_t count) {
  PulseColumns slice = pulses;
  slice.size = count;
  for (std::span<const float>& column : slice.axis) {
    if (column.size() > 1) column = column.subspan(begin, count);
  }
  return slice;
}

AnswerColumns From(AnswerColumns answers, std::size_t begin) {
  const auto advance = [begin](auto*& column) {
    if (column != nullptr) column += begin;
  };
  advance(answers.outcomes);
  advance(answers.outcome_axes);
  for (float*& column : answers.values) advance(column);
  for (float*& column : answers.standard_errors) advance(column);
  advance(answers.best_s44_orders);
  advance(answers.remaining_thu);
  advance(answers.remaining_tvu);
  return answers;
}

}  // namespace

ServerSource::ServerSource(std::string address, std::unique_ptr<Stub> stub, TableSummary summary)
    : address_(std::move(address)), stub_(std::move(stub)), summary_(std::move(summary)) {}

absl::StatusOr<std::unique_ptr<ServerSource>> ServerSource::Open(const std::string& address,
                                                                 const std::string& table) {
  std::unique_ptr<Stub> stub = Connect(address);
  absl::StatusOr<TableSummary> summary = GetTable(address, *stub, table);
  if (!summary.ok()) return summary.status();
  return std::unique_ptr<ServerSource>(new ServerSource(address, std::move(stub), *std::move(summary)));
}

absl::Status ServerSource::Answer(const Query& query, const PulseColumns& pulses,
                                  const AnswerColumns& answers) {
  for (std::size_t begin = 0; begin < pulses.size; begin += kMostPulses) {
    const std::size_t count = std::min(kMostPulses, pulses.size - begin);
    absl::Status status = AnswerBatch(query, Slice(pulses, begin, count), From(answers, begin));
    if (!status.ok()) return status;
  }
  return absl::OkStatus();
}

absl::Status ServerSource::AnswerBatch(const Query& query, const PulseColumns& pulses,
                                       const AnswerColumns& answers) {
  albtpu::v1::QueryColumnsRequest request;
  request.mutable_options()->set_table(summary_.name);
  ToWire(query, answers, request);
  ToWire(pulses, *request.mutable_pulses());
  grpc::ClientContext context;
  SetDeadline(context);
  albtpu::v1::QueryColumnsResponse response;
  absl::Status status = FromServer(address_, stub_->QueryColumns(&context, request, &response));
  if (!status.ok()) return status;
  if (response.table().digest() != summary_.digest) {
    return absl::AbortedError(absl::StrCat("server ", address_, ": table ", summary_.name,
                                           " changed from digest ", summary_.digest, " to ",
                                           response.table().digest(), " while it was asked: start again"));
  }
  const absl::Status read = FromWire(response, pulses.size, answers);
  return read.ok() ? read : absl::InternalError(absl::StrCat("server ", address_, ": ", read.message()));
}

absl::StatusOr<std::vector<TableSummary>> ListServerTables(const std::string& address) {
  const auto stub = Connect(address);
  grpc::ClientContext context;
  SetDeadline(context);
  albtpu::v1::ListTablesResponse response;
  absl::Status status = FromServer(address, stub->ListTables(&context, {}, &response));
  if (!status.ok()) return status;
  std::vector<TableSummary> tables;
  for (const auto& listed : response.tables()) {
    absl::StatusOr<TableSummary> table = GetTable(address, *stub, listed.reference().name());
    if (!table.ok()) return table.status();
    table->is_default = listed.reference().name() == response.default_table();
    tables.push_back(*std::move(table));
  }
  return tables;
}

}  // namespace albtpu::client
