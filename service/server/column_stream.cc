#include "service/server/column_stream.h"

#include "service/server/byte_answers.h"
#include "service/server/limits.h"

namespace albtpu::server {

ColumnStream::ColumnStream(const TableCatalog& catalog, Workers& workers,
                           const grpc::CallbackServerContext& context)
    : catalog_(catalog), workers_(workers), context_(context) {
  StartRead(&next_);
}

void ColumnStream::OnReadDone(bool ok) {
  {
    const std::lock_guard lock(mutex_);
    (ok ? waiting_ : read_all_) = true;
  }
  Proceed();
}

void ColumnStream::OnWriteDone(bool ok) {
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
  if (!answer) return Finish(grpc::Status::OK);
  StartRead(&next_);
  if (current_.Length() <= kMaxInlineBytes) return Answer();
  workers_.Run([this] { Answer(); });
}

void ColumnStream::Answer() {
  const grpc::Status status =
      context_.IsCancelled() ? grpc::Status::CANCELLED : AnswerStreamColumns(catalog_, current_, answer_);
  current_.Clear();
  if (status.ok()) return StartWrite(&answer_);
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  Finish(status);
}

}  // namespace albtpu::server
