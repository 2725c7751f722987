#include "service/client/column_exchange.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>

#include "absl/strings/str_cat.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/client/answer_reader.h"
#include "service/client/channel.h"
#include "service/client/wire.h"
#include "status/status_macros.h"

namespace albtpu::client {
namespace {

using std::chrono::system_clock;

constexpr char kMethod[] = "/albtpu.v1.UncertaintyService/StreamColumns";

// Messages sent ahead of the answers: one being received, one being answered, and one under way in each direction.
constexpr std::size_t kMessagesAhead = 4;

// Time limit from one answer to the next.
constexpr std::chrono::seconds kDeadline{60};

AnswerColumns Offset(AnswerColumns answers, std::size_t begin) {
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

// The thread that makes the call also drives it: gRPC reports events through a queue, and at most one operation of each
// kind is pending.
class Call {
 public:
  Call(grpc::GenericStub& stub, const ColumnTask& task, std::size_t begin)
      : task_(task), sent_(begin), answered_(begin) {
    request_without_pulses_.mutable_options()->set_table(task.table);
    request_without_pulses_.mutable_options()->set_refractive_index(task.refractive_index);
    if (task.sea != nullptr) *request_without_pulses_.mutable_sea() = *task.sea;
    ToWire(task.query, task.answers, request_without_pulses_);
    stream_ = stub.PrepareCall(&context_, kMethod, &events_);
    stream_->StartCall(Tag(kStarted));
  }

  ~Call() {
    events_.Shutdown();
    void* event;
    bool ok;
    while (events_.Next(&event, &ok)) {
    }
  }

  absl::Status Run() {
    while (!finished_) {
      void* event = nullptr;
      bool ok = false;
      const auto next = events_.AsyncNext(&event, &ok, system_clock::now() + kDeadline);
      if (next == grpc::CompletionQueue::TIMEOUT)
        Fail(absl::DeadlineExceededError(absl::StrCat("no answer for ", kDeadline.count(), " s")));
      else
        Handle(static_cast<Event>(reinterpret_cast<std::uintptr_t>(event)), ok);
    }
    if (!failure_.ok()) return failure_;
    if (!status_.ok()) return FromGrpc(status_);
    if (answered_ < task_.pulses.size) return absl::UnavailableError("the server ended the call early");
    return absl::OkStatus();
  }

  std::size_t answered() const { return answered_; }

 private:
  enum Event : std::uintptr_t { kStarted = 1, kWritten, kClosed, kRead, kFinished };

  static void* Tag(Event event) { return reinterpret_cast<void*>(static_cast<std::uintptr_t>(event)); }

  void Handle(Event event, bool ok) {
    switch (event) {
      case kStarted:
        if (!ok) return Finish();
        stream_->Read(&response_, Tag(kRead));
        return Write();
      case kWritten:
        writing_ = false;
        return ok ? Write() : void();  // The pending read fails, too, and ends the call.
      case kClosed:
        return;
      case kRead:
        if (!ok) return Finish();
        if (absl::Status status = failure_.ok() ? TakeAnswer() : absl::OkStatus(); !status.ok()) Fail(status);
        stream_->Read(&response_, Tag(kRead));
        return Write();
      case kFinished:
        finished_ = true;
        return;
    }
  }

  // Sends the next message if it is due, or announces that there are no more.
  void Write() {
    if (writing_ || closed_ || !failure_.ok()) return;
    if (sent_ == task_.pulses.size) {
      closed_ = true;
      return stream_->WritesDone(Tag(kClosed));
    }
    if (sent_ >= answered_ + kMessagesAhead * kMostPulses) return;
    const std::size_t count = std::min(kMostPulses, task_.pulses.size - sent_);
    ColumnMessage request;
    request.Add(request_without_pulses_);
    AddPulses(Slice(task_.pulses, sent_, count), request);
    request.Nest(albtpu::v1::StreamColumnsRequest::kQueryFieldNumber, 0);
    sent_ += count;
    writing_ = true;
    stream_->Write(request.Finish(), Tag(kWritten));
  }

  // Reads an answer into its place among the answers.
  absl::Status TakeAnswer() {
    if (answered_ == sent_) return absl::InternalError("answered more pulses than were queried");
    const std::size_t count = std::min(kMostPulses, task_.pulses.size - answered_);
    const auto answer = ReadStreamedAnswer(response_, task_.query, count, Offset(task_.answers, answered_));
    response_.Clear();
    if (!answer.ok()) return answer.status();
    RETURN_IF_ERROR(CheckDigest(task_.table, task_.sea != nullptr, task_.digest, answer->table().digest()));
    answered_ += count;
    return absl::OkStatus();
  }

  // Cancels the call. The first reason is the one reported.
  void Fail(absl::Status reason) {
    failure_.Update(reason);
    context_.TryCancel();
  }

  void Finish() { stream_->Finish(&status_, Tag(kFinished)); }

  const ColumnTask& task_;
  std::size_t sent_, answered_;  // Pulses.
  bool writing_ = false, closed_ = false, finished_ = false;
  absl::Status failure_;

  grpc::ClientContext context_;
  grpc::CompletionQueue events_;
  albtpu::v1::QueryColumnsRequest request_without_pulses_;
  grpc::ByteBuffer response_;
  grpc::Status status_;
  std::unique_ptr<grpc::GenericClientAsyncReaderWriter> stream_;
};

}  // namespace

absl::Status CheckDigest(const std::string& table, bool of_sea, const std::string& digest,
                         const std::string& answered) {
  if (answered == digest) return absl::OkStatus();
  return absl::AbortedError(absl::StrCat(
      of_sea ? "the table of the sea" : absl::StrCat("table ", table), " changed from digest ", digest, " to ",
      answered,
      of_sea ? " during the query (another server computed it); ask a single server" : " during the query; run again"));
}

absl::Status QueryByStream(grpc::GenericStub& stub, const ColumnTask& task, std::size_t& begin) {
  Call call(stub, task, begin);
  const absl::Status status = call.Run();
  begin = call.answered();
  return status;
}

}  // namespace albtpu::client
