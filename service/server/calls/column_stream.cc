#include "service/server/calls/column_stream.h"

#include <utility>
#include <variant>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "service/server/calls/query_rows.h"
#include "service/server/ground/errors.h"
#include "service/server/ground/limits.h"

namespace albtpu::server {

ColumnStream::ColumnStream(std::shared_ptr<const TableCatalog> catalog, SeaTables& seas, Workers& workers,
                           const CallRecord& record, grpc::CallbackServerContext& context,
                           std::chrono::seconds max_idle, const std::atomic<bool>& draining)
    : catalog_(std::move(catalog)),
      seas_(seas),
      workers_(workers),
      record_(record),
      context_(context),
      max_idle_(max_idle),
      draining_(draining),
      idle_watch_(max_idle, [this] { EndIdle(); }) {
  StartRead(&next_);
}

void ColumnStream::OnReadDone(bool ok) {
  idle_watch_.NoteActivity();
  {
    const std::lock_guard lock(mutex_);
    (ok ? waiting_ : read_all_) = true;
  }
  Proceed();
}

void ColumnStream::OnWriteDone(bool ok) {
  idle_watch_.NoteActivity();
  answer_.Clear();
  {
    const std::lock_guard lock(mutex_);
    busy_ = false;
    if (!ok) read_all_ = true;
  }
  Proceed();
}

void ColumnStream::OnDone() {
  workers_.Release();
  delete this;
}

void ColumnStream::Proceed() {
  bool handle;
  {
    const std::lock_guard lock(mutex_);
    if (busy_ || ended_ || !(waiting_ || read_all_)) return;
    handle = busy_ = waiting_;
    ended_ = !handle;
    waiting_ = false;
    if (handle) current_.Swap(&next_);
  }
  // Without the lock: once the call is finished, this object may no longer exist.
  if (!handle) return End(context_.IsCancelled() ? grpc::Status::CANCELLED : grpc::Status::OK);
  current_begin_ = CallRecord::Clock::now();
  idle_watch_.Pause();
  StartRead(&next_);
  if (current_.Length() <= kMaxInlineBytes) return HandleRequest(nullptr);
  workers_.Run([this] { HandleRequest(nullptr); });
}

grpc::Status ColumnStream::RunHandler(AnswerSources& sources) {
  const RequestScope scope(record_.request_id());
  OutcomeTally tally;
  const grpc::Status status = HandleStreamColumns(sources, current_, answer_, tally);
  if (status.ok()) record_.CountAnswer(tally, current_begin_);
  return status;
}

void ColumnStream::HandleRequest(std::shared_ptr<const ServedTable> compiled) {
  if (context_.IsCancelled()) return Fail(grpc::Status::CANCELLED);
  AnswerSources sources(*catalog_, seas_, nullptr, {.table = std::move(compiled), .water = nullptr});
  const grpc::Status status = RunHandler(sources);
  if (sources.wanted()) return AwaitTable(std::get<WantedTable>(*sources.wanted()));
  if (!status.ok()) return Fail(status);
  current_.Clear();
  idle_watch_.Resume();
  StartWrite(&answer_);
}

void ColumnStream::AwaitTable(const WantedTable& wanted) {
  seas_.Compile(wanted, [this](const SeaTables::Result& table) {
    if (!table.ok()) return Fail(ToGrpcStatus(Within("query", table.status())));
    workers_.Run([this, table = *table] { HandleRequest(table); });
  });
}

void ColumnStream::Fail(const grpc::Status& status) {
  current_.Clear();
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  End(status);
}

void ColumnStream::End(const grpc::Status& status) {
  const auto finish = [this, status](bool /*waited*/) {
    record_.End(status);
    Finish(status);
  };
  if (!draining_) return finish(true);
  end_alarm_.Set(std::chrono::system_clock::now() + kTimeToReadAnswers, finish);
}

void ColumnStream::EndIdle() {
  {
    const std::lock_guard lock(mutex_);
    if (ended_) return;
    if (busy_) return context_.TryCancel();
    ended_ = true;
  }
  End(ToGrpcStatus(absl::DeadlineExceededError(absl::StrCat(
      "no request for ", max_idle_.count(), " s; end a stream after its last request, and open another"))));
}

}  // namespace albtpu::server
