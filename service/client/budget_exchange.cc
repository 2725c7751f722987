#include "service/client/budget_exchange.h"

#include <grpcpp/support/proto_buffer_reader.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <deque>
#include <memory>
#include <utility>

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/client/answer_reader.h"
#include "service/client/channel.h"
#include "service/client/column_exchange.h"
#include "service/client/wire.h"
#include "service/wire_values.h"

namespace albtpu::client {
namespace {

namespace v1 = albtpu::v1;

// Bytes of columns in a message, which may have 4 MiB (uncertainty_service.proto). The rest is for everything else,
// most of it a sea.
constexpr std::size_t kMaxColumnBytes = (std::size_t{4} << 20) - (std::size_t{192} << 10);

constexpr char kBudgetMethod[] = "/albtpu.v1.UncertaintyService/QueryBudget";

// One being received, one being answered, and one under way in each direction.
constexpr std::size_t kCallsAtATime = 4;

// Time limit of one call.
constexpr std::chrono::seconds kBudgetDeadline{60};

// The number of pulses that a message of these columns takes, request and answer.
std::size_t MaxPulses(const BudgetPulses& pulses, const BudgetAnswers& wanted) {
  std::size_t asked = sizeof(float);  // The depth may be repeated.
  for (const std::span<const float> column : pulses.pulses.axis) asked += column.size() > 1 ? sizeof(float) : 0;
  for (const BudgetInput input : kAircraftInputs) asked += pulses.aircraft[input].size() > 1 ? sizeof(float) : 0;
  std::size_t answered = 3;  // Outcome, axis and order.
  for (std::size_t i = 0; i < kBudgetQuantityCount; ++i) {
    const auto quantity = static_cast<BudgetQuantity>(i);
    if (Wants(wanted, quantity)) answered += ColumnCount(quantity) * sizeof(float);
  }
  return std::min(kMostPulses, kMaxColumnBytes / std::max(asked, answered));
}

// The column of a quantity: field i + 1 is quantity i.
const std::string& ColumnOf(const v1::BudgetColumns& budget, BudgetQuantity quantity) {
  const int field = static_cast<int>(quantity) + 1;
  static const std::string* const kScratch = new std::string();
  return budget.GetReflection()->GetStringReference(budget, v1::BudgetColumns::descriptor()->FindFieldByNumber(field),
                                                    const_cast<std::string*>(kScratch));
}

absl::Status WrongLength(const char* name, std::size_t bytes, std::size_t count) {
  return absl::InternalError(absl::StrCat("answered ", bytes, " bytes of ", name, " for ", count, " pulses"));
}

// Copies one byte for each pulse, of which none may be outside `least` to `most`.
absl::Status CopyBytes(const char* name, const std::string& bytes, std::size_t count, int least, int most,
                       std::uint8_t* destination) {
  if (destination == nullptr) return absl::OkStatus();
  if (bytes.size() != count) return WrongLength(name, bytes.size(), count);
  std::memcpy(destination, bytes.data(), count);
  return CheckNumbers(destination, count, name, least, most);
}

absl::Status CopyFloats(const v1::BudgetColumns& budget, BudgetQuantity quantity, std::size_t begin, std::size_t count,
                        const BudgetAnswers& answers) {
  const std::string& bytes = ColumnOf(budget, quantity);
  const std::size_t columns = ColumnCount(quantity), size = count * sizeof(float);
  if (bytes.size() != columns * size) return WrongLength("the budget", bytes.size(), count);
  for (std::size_t i = 0; i < columns; ++i) {
    float* const column = answers.columns[FirstColumn(quantity) + i];
    if (column != nullptr) std::memcpy(column + begin, bytes.data() + i * size, size);
  }
  return absl::OkStatus();
}

// Reads a QueryBudgetResponse about `count` pulses of a task. Fills the columns of its answers from `begin` on, and its
// summary of the water; returns the digest of the table. Internal when the answer violates the protocol: its coverage
// is not that of the task, a column has the wrong length, or a number is not a known outcome, axis or order.
// FailedPrecondition where the server knows no waters: its totals lack them.
absl::StatusOr<std::string> ReadBudget(grpc::ByteBuffer& bytes, const BudgetTask& task, std::size_t begin,
                                       std::size_t count) {
  const BudgetAnswers& answers = task.answers;
  v1::QueryBudgetResponse response;
  grpc::ProtoBufferReader reader(&bytes);
  if (!reader.status().ok() || !response.ParseFromZeroCopyStream(&reader))
    return absl::InternalError("answered bytes that are not a valid message");
  if (task.water != nullptr && !response.has_water()) {
    return absl::FailedPreconditionError(
        "computes no water (it is of an earlier version); give the water's columns, or ask a later server");
  }
  const v1::Coverage coverage = ToWire(task.query.coverage);
  if (response.coverage() != coverage)
    return absl::InternalError(absl::StrCat("answered coverage ", response.coverage(), "; expected ", coverage));
  const auto at = [begin](std::uint8_t* column) { return column == nullptr ? nullptr : column + begin; };
  absl::Status status = CopyBytes("outcomes", response.outcomes(), count, 1, v1::Outcome_MAX, at(answers.outcomes));
  status.Update(CopyBytes("outcome axes", response.outcome_axes(), count, 0, v1::Axis_MAX, at(answers.outcome_axes)));
  status.Update(CopyBytes("best orders", response.budget().best_s44_orders(), count, 0, v1::S44Order_MAX,
                          at(answers.best_s44_orders)));
  for (std::size_t i = 0; i < kBudgetQuantityCount; ++i) {
    const auto quantity = static_cast<BudgetQuantity>(i);
    if (quantity == BudgetQuantity::kBestS44Order || !Wants(answers, quantity)) continue;
    status.Update(CopyFloats(response.budget(), quantity, begin, count, answers));
  }
  if (!status.ok()) return status;
  if (task.summary != nullptr) *task.summary = FromWire(response.water());
  return response.table().digest();
}

struct BudgetCall {
  BudgetCall(std::size_t first, std::size_t pulses) : begin(first), count(pulses) {}

  const std::size_t begin, count;
  bool done = false;
  grpc::ClientContext context;
  grpc::ByteBuffer response;
  grpc::Status status;
  std::unique_ptr<grpc::GenericClientAsyncResponseReader> reader;
};

// The thread that makes the calls also drives them: gRPC reports their ends through a queue.
class Calls {
 public:
  Calls(grpc::GenericStub& stub, const BudgetTask& task, std::size_t begin)
      : stub_(stub), task_(task), most_(MaxPulses(task.pulses, task.answers)), sent_(begin), answered_(begin) {
    if (task.water != nullptr) *request_without_pulses_.mutable_water() = *task.water;
    if (task.sea != nullptr) *request_without_pulses_.mutable_sea() = *task.sea;
    ToWire(task.query, task.pulses, task.answers, request_without_pulses_);
    request_without_pulses_.mutable_options()->set_table(task.table);
  }

  absl::Status Run() {
    while (true) {
      while (failure_.ok() && calls_.size() < kCallsAtATime && sent_ < task_.pulses.pulses.size) Send();
      if (calls_.empty()) return failure_;
      void* ended = nullptr;
      bool ok = false;
      events_.Next(&ended, &ok);
      BudgetCall& call = *static_cast<BudgetCall*>(ended);
      call.done = true;
      if (!call.status.ok()) Fail(FromGrpc(call.status));
      while (!calls_.empty() && calls_.front()->done) {
        if (failure_.ok()) TakeAnswer(*calls_.front());
        calls_.pop_front();
      }
    }
  }

  std::size_t answered() const { return answered_; }

 private:
  void Send() {
    auto call = std::make_unique<BudgetCall>(sent_, std::min(most_, task_.pulses.pulses.size - sent_));
    ColumnMessage request;
    request.Add(request_without_pulses_);
    AddPulses(Slice(task_.pulses, call->begin, call->count), request);
    call->context.set_deadline(std::chrono::system_clock::now() + kBudgetDeadline);
    call->reader = stub_.PrepareUnaryCall(&call->context, kBudgetMethod, request.Finish(), &events_);
    call->reader->StartCall();
    call->reader->Finish(&call->response, &call->status, call.get());
    sent_ += call->count;
    calls_.push_back(std::move(call));
  }

  // Reads an answer into its place among the answers.
  void TakeAnswer(BudgetCall& call) {
    const absl::StatusOr<std::string> digest = ReadBudget(call.response, task_, call.begin, call.count);
    if (!digest.ok()) return Fail(digest.status());
    absl::Status status = CheckDigest(task_.table, task_.sea != nullptr, task_.digest, *digest);
    if (!status.ok()) return Fail(std::move(status));
    answered_ += call.count;
  }

  // Cancels all calls. The first reason is the one reported.
  void Fail(absl::Status reason) {
    failure_.Update(std::move(reason));
    for (const auto& call : calls_) call->context.TryCancel();
  }

  grpc::GenericStub& stub_;
  const BudgetTask& task_;
  const std::size_t most_;       // Pulses of a call.
  std::size_t sent_, answered_;  // Pulses.
  absl::Status failure_;
  grpc::CompletionQueue events_;
  v1::QueryBudgetRequest request_without_pulses_;
  std::deque<std::unique_ptr<BudgetCall>> calls_;  // In the order of their pulses.
};

}  // namespace

absl::Status QueryByCalls(grpc::GenericStub& stub, const BudgetTask& task, std::size_t& begin) {
  Calls calls(stub, task, begin);
  const absl::Status status = calls.Run();
  begin = calls.answered();
  return status;
}

}  // namespace albtpu::client
