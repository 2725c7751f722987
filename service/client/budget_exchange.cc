#include "service/client/budget_exchange.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <memory>

#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/client/budget_wire.h"
#include "service/client/column_exchange.h"
#include "service/client/server_error.h"

namespace albtpu::client {
namespace {

constexpr char kMethod[] = "/albtpu.v1.UncertaintyService/QueryBudget";

// One being received, one being answered, and one under way in each direction.
constexpr std::size_t kCallsAtATime = 4;

// Time limit of one call.
constexpr std::chrono::seconds kDeadline{60};

struct Call {
  Call(std::size_t first, std::size_t pulses) : begin(first), count(pulses) {}

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
      : stub_(stub),
        task_(task),
        most_(MostPulses(task.pulses, task.answers)),
        sent_(begin),
        answered_(begin) {
    if (task.sea != nullptr) *request_without_pulses_.mutable_sea() = *task.sea;
    ToWire(task.options, task.pulses, task.answers, request_without_pulses_);
    request_without_pulses_.mutable_options()->set_table(task.table);
  }

  absl::Status Run() {
    while (true) {
      while (failure_.ok() && calls_.size() < kCallsAtATime && sent_ < task_.pulses.pulses.size) Send();
      if (calls_.empty()) return failure_;
      void* ended = nullptr;
      bool ok = false;
      events_.Next(&ended, &ok);
      Call& call = *static_cast<Call*>(ended);
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
    auto call = std::make_unique<Call>(sent_, std::min(most_, task_.pulses.pulses.size - sent_));
    ColumnMessage request;
    request.Add(request_without_pulses_);
    AddPulses(Slice(task_.pulses, call->begin, call->count), request);
    call->context.set_deadline(std::chrono::system_clock::now() + kDeadline);
    call->reader = stub_.PrepareUnaryCall(&call->context, kMethod, request.Finish(), &events_);
    call->reader->StartCall();
    call->reader->Finish(&call->response, &call->status, call.get());
    sent_ += call->count;
    calls_.push_back(std::move(call));
  }

  // Reads an answer into its place among the answers.
  void TakeAnswer(Call& call) {
    const absl::StatusOr<std::string> digest =
        ReadBudget(call.response, task_.options, call.begin, call.count, task_.answers);
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
  albtpu::v1::QueryBudgetRequest request_without_pulses_;
  std::deque<std::unique_ptr<Call>> calls_;  // In the order of their pulses.
};

}  // namespace

absl::Status QueryByCalls(grpc::GenericStub& stub, const BudgetTask& task, std::size_t& begin) {
  Calls calls(stub, task, begin);
  const absl::Status status = calls.Run();
  begin = calls.answered();
  return status;
}

}  // namespace albtpu::client
