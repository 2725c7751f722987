#include "service/server/calls/column_stream.h"

#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "service/server/calls/byte_answers.h"
#include "service/server/ground/limits.h"
#include "service/server/ground/status.h"

namespace albtpu::server {

ColumnStream::ColumnStream(std::shared_ptr<const TableCatalog> catalog, Workers& workers,
                           const CallRecord& record, grpc::CallbackServerContext& context)
    : catalog_(std::move(catalog)),
      workers_(workers),
      record_(record),
      context_(context),
      idle_watch_(kMaxStreamIdle, [this] { EndIdle(); }) {
  StartRead(&next_);
}

void ColumnStream::OnReadDone(bool ok) {
  idle_watch_.Moved();
  {
    const std::lock_guard lock(mutex_);
    (ok ? waiting_ : read_all_) = true;
  }
  Proceed();
}

void ColumnStream::OnWriteDone(bool ok) {
  idle_watch_.Moved();
  answer_.Clear();
  {
    const std::lock_guard lock(mutex_);
    busy_ = false;
    if (!ok) read_all_ = true;
  }
  Proceed();
}

void ColumnStream::OnDone() {
  workers_.Dismiss();
  delete this;
}

void ColumnStream::Proceed() {
  bool answer;
  {
    const std::lock_guard lock(mutex_);
    if (busy_ || ended_ || !(waiting_ || read_all_)) return;
    answer = busy_ = waiting_;
    ended_ = !answer;
    waiting_ = false;
    if (answer) current_.Swap(&next_);
  }
  // The lock is open: once the call is finished it may be gone.
  if (!answer) return End(context_.IsCancelled() ? grpc::Status::CANCELLED : grpc::Status::OK);
  asked_ = CallRecord::Clock::now();
  StartRead(&next_);
  if (current_.Length() <= kMaxInlineBytes) return Answer();
  workers_.Run([this] { Answer(); });
}

grpc::Status ColumnStream::MakeAnswer() {
  const RequestScope scope(record_.request_id());
  OutcomeTally tally;
  const grpc::Status status = AnswerStreamColumns(*catalog_, current_, answer_, tally);
  if (status.ok()) record_.CountAnswer(tally, asked_);
  return status;
}

void ColumnStream::Answer() {
  const grpc::Status status = context_.IsCancelled() ? grpc::Status::CANCELLED : MakeAnswer();
  current_.Clear();
  if (status.ok()) return StartWrite(&answer_);
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  End(status);
}

void ColumnStream::End(const grpc::Status& status) {
  record_.End(status);
  Finish(status);
}

void ColumnStream::EndIdle() {
  {
    const std::lock_guard lock(mutex_);
    if (ended_) return;
    if (busy_) return context_.TryCancel();
    ended_ = true;
  }
  End(ToGrpcStatus(absl::DeadlineExceededError(absl::StrCat(
      "no request for ", kMaxStreamIdle.count(), " s: end a stream when all is asked, and begin another"))));
}

}  // namespace albtpu::server
