#include "service/server/calls/uncertainty_service.h"

#include <grpc/grpc.h>

#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "service/server/calls/column_stream.h"
#include "service/server/ground/errors.h"
#include "service/server/tables/wire_enums.h"

namespace albtpu::server {
UnreadAnswers::UnreadAnswers(CallMetrics& metrics, Clock::duration limit)
    : metrics_(metrics), limit_(limit), dropping_(std::chrono::seconds(1), [this] { DropUnread(Clock::now()); }) {}

UnreadAnswers::Entry::Entry(UnreadAnswers& all, grpc::CallbackServerContext& context, std::size_t bytes)
    : all_(all), context_(context), bytes_(bytes) {
  all_.bytes_ += bytes_;
  const std::lock_guard lock(all_.mutex_);
  place_ = all_.entries_.insert(all_.entries_.end(), this);
}

UnreadAnswers::Entry::~Entry() {
  all_.bytes_ -= bytes_;
  const std::lock_guard lock(all_.mutex_);
  all_.entries_.erase(place_);
}

void UnreadAnswers::DropUnread(Clock::time_point now) {
  // Calls are cancelled after the lock is released, because gRPC may do other work while it cancels. Until then a
  // reference keeps each call alive.
  std::vector<grpc_call*> calls;
  {
    const std::lock_guard lock(mutex_);
    const Clock::duration limit = bytes_ > kMaxUnreadBytes / 2 ? Clock::duration(kMaxUnreadTimeWhenCrowded) : limit_;
    for (Entry* entry : entries_) {
      if (now - entry->made_ < limit) break;
      if (entry->dropped_) continue;
      entry->dropped_ = true;
      grpc_call_ref(calls.emplace_back(entry->context_.c_call()));
    }
  }
  for (grpc_call* call : calls) {
    metrics_.CountUnread();  // Before the caller can notice.
    grpc_call_cancel_with_status(call, GRPC_STATUS_DEADLINE_EXCEEDED,
                                 "the answer was not read in time; read answers as they arrive", nullptr);
    grpc_call_unref(call);
  }
}

namespace {

using ByteStream = grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>;

grpc::Status TooManyCalls() {
  return ToGrpcStatus(
      absl::ResourceExhaustedError("the server has no place for another long call; wait and try again"));
}

// gRPC also passes on requests that did not arrive completely.
grpc::Status NotReceived(const grpc::CallbackServerContext& context) {
  if (context.IsCancelled()) return grpc::Status::CANCELLED;
  return ToGrpcStatus(absl::UnavailableError("the request did not arrive completely; send it again"));
}

grpc::Status TooManyUnread() {
  return ToGrpcStatus(absl::ResourceExhaustedError(
      "unread answers fill the memory reserved for them; read your answers, wait and try again"));
}

// Holds an answer on its way to the caller.
class Delivery final : public grpc::ServerUnaryReactor {
 public:
  Delivery(UnreadAnswers& unread, grpc::CallbackServerContext& context, std::size_t bytes)
      : unread_(unread, context, bytes) {
    Finish(grpc::Status::OK);
  }

 private:
  void OnDone() override { delete this; }

  // As in gRPC's own reactors: OnDone() is short, and handing it to another thread would take a quarter of the time
  // of a short call.
  bool InternalInlineable() override { return true; }

  const UnreadAnswers::Entry unread_;
};

grpc::ServerUnaryReactor* Fail(grpc::CallbackServerContext& context, CallRecord& record, const grpc::Status& status) {
  grpc::ServerUnaryReactor* reactor = context.DefaultReactor();
  record.End(status);
  reactor->Finish(status);
  return reactor;
}

// Sends the answer unless too much is unread. `bytes` is the size of request and answer together.
grpc::ServerUnaryReactor* Deliver(UnreadAnswers& unread, grpc::CallbackServerContext& context, CallRecord& record,
                                  std::size_t bytes) {
  if (!unread.HasRoomFor(bytes)) return Fail(context, record, TooManyUnread());
  record.End(grpc::Status::OK);
  return new Delivery(unread, context, bytes);
}

// Runs the handler of a single call and records its answer.
grpc::Status RunHandler(CallRecord& record, MessageHandler handler, AnswerSources& sources,
                        const grpc::ByteBuffer& request, grpc::ByteBuffer& response) {
  const RequestScope scope(record.request_id());
  OutcomeTally tally;
  const grpc::Status status = handler(sources, request, response, tally);
  if (status.ok() && tally.pulses() > 0) record.CountAnswer(tally, record.begin());
  return status;
}

class RefusedStream final : public ByteStream {
 public:
  explicit RefusedStream(const grpc::Status& status) { Finish(status); }
  void OnDone() override { delete this; }
};

}  // namespace

// A request that waits for a worker, or first for its table and its water. The workers must have admitted it; its place
// is released at the end.
class UncertaintyService::LongCall final : public grpc::ServerUnaryReactor {
 public:
  using Wanted = std::optional<std::variant<WantedTable, WantedWater>>;

  // `wanted` is to be made first, if there is one.
  LongCall(UncertaintyService& service, const CallRecord& record, grpc::CallbackServerContext& context,
           MessageHandler handler, std::shared_ptr<const TableCatalog> catalog, const grpc::ByteBuffer& request,
           grpc::ByteBuffer& response, const Wanted& wanted)
      : service_(service),
        record_(record),
        context_(context),
        handler_(handler),
        catalog_(std::move(catalog)),
        request_(request),
        response_(response) {
    if (wanted)
      Await(*wanted);
    else
      service_.workers_.Run([this] { HandleRequest(); });
  }

 private:
  void Await(const std::variant<WantedTable, WantedWater>& wanted) {
    if (const WantedTable* const table = std::get_if<WantedTable>(&wanted))
      service_.seas_.Compile(*table, [this](const SeaTables::Result& result) { Take(result, made_.table); });
    else
      service_.waters_.Compile(std::get<WantedWater>(wanted),
                               [this](const WaterShares::Result& result) { Take(result, made_.water); });
  }

  template <typename Value>
  void Take(const absl::StatusOr<std::shared_ptr<const Value>>& result, std::shared_ptr<const Value>& made) {
    if (!result.ok()) return End(ToGrpcStatus(result.status()));
    made = *result;
    service_.workers_.Run([this] { HandleRequest(); });
  }

  void HandleRequest() {
    if (context_.IsCancelled()) return End(grpc::Status::CANCELLED);
    AnswerSources sources(*catalog_, service_.seas_, &service_.waters_, made_);
    const grpc::Status status = RunHandler(record_, handler_, sources, request_, response_);
    if (sources.wanted()) return Await(*sources.wanted());
    End(status);
  }

  void End(const grpc::Status& status) {
    record_.End(status);
    // Counts no bytes: its place among the long calls already bounds them.
    if (status.ok()) unread_.emplace(service_.unread_, context_, 0);
    Finish(status);
  }

  void OnDone() override {
    service_.workers_.Release();
    delete this;
  }

  UncertaintyService& service_;
  CallRecord record_;  // Used by one thread at a time.
  grpc::CallbackServerContext& context_;
  const MessageHandler handler_;
  const std::shared_ptr<const TableCatalog> catalog_;
  const grpc::ByteBuffer& request_;
  grpc::ByteBuffer& response_;
  MadeForRequest made_;
  std::optional<UnreadAnswers::Entry> unread_;
};

grpc::ServerUnaryReactor* UncertaintyService::Handle(Method method, MessageHandler handler, std::size_t inline_bytes,
                                                     grpc::CallbackServerContext& context,
                                                     const grpc::ByteBuffer& request, grpc::ByteBuffer& response) {
  CallRecord record(recorders_, method, context);
  if (!request.Valid()) return Fail(context, record, NotReceived(context));
  const std::shared_ptr<const TableCatalog> catalog = tables_.current();
  const std::size_t length = request.Length();
  LongCall::Wanted wanted;
  if (length <= inline_bytes) {
    if (!unread_.HasRoomFor(length)) return Fail(context, record, TooManyUnread());
    AnswerSources sources(*catalog, seas_, &waters_);
    const grpc::Status status = RunHandler(record, handler, sources, request, response);
    wanted = sources.wanted();
    if (!wanted && !status.ok()) return Fail(context, record, status);
    if (!wanted) return Deliver(unread_, context, record, length + response.Length());
  }
  if (!workers_.Admit()) return Fail(context, record, TooManyCalls());
  return new LongCall(*this, record, context, handler, catalog, request, response, wanted);
}

grpc::ServerUnaryReactor* UncertaintyService::QueryPulses(grpc::CallbackServerContext* context,
                                                          const grpc::ByteBuffer* request, grpc::ByteBuffer* response) {
  return Handle(Method::kQueryPulses, HandleQueryPulses, kMaxInlineBytes, *context, *request, *response);
}

grpc::ServerUnaryReactor* UncertaintyService::QueryColumns(grpc::CallbackServerContext* context,
                                                           const grpc::ByteBuffer* request,
                                                           grpc::ByteBuffer* response) {
  return Handle(Method::kQueryColumns, HandleQueryColumns, kMaxInlineBytes, *context, *request, *response);
}

grpc::ServerUnaryReactor* UncertaintyService::QueryBudget(grpc::CallbackServerContext* context,
                                                          const grpc::ByteBuffer* request, grpc::ByteBuffer* response) {
  return Handle(Method::kQueryBudget, HandleQueryBudget, kMaxInlineBudgetBytes, *context, *request, *response);
}

// Never at once: the file of a table takes milliseconds.
grpc::ServerUnaryReactor* UncertaintyService::CompileSea(grpc::CallbackServerContext* context,
                                                         const grpc::ByteBuffer* request, grpc::ByteBuffer* response) {
  return Handle(Method::kCompileSea, HandleCompileSea, 0, *context, *request, *response);
}

ByteStream* UncertaintyService::StreamColumns(grpc::CallbackServerContext* context) {
  CallRecord record(recorders_, Method::kStreamColumns, *context);
  if (workers_.Admit()) {
    return new ColumnStream(tables_.current(), seas_, workers_, record, *context, max_stream_idle_, draining_);
  }
  const grpc::Status refusal = TooManyCalls();
  record.End(refusal);
  return new RefusedStream(refusal);
}

grpc::ServerUnaryReactor* UncertaintyService::ListTables(grpc::CallbackServerContext* context,
                                                         const grpc::ByteBuffer* request, grpc::ByteBuffer* response) {
  return Handle(Method::kListTables, HandleListTables, kMaxInlineBytes, *context, *request, *response);
}

grpc::ServerUnaryReactor* UncertaintyService::GetTable(grpc::CallbackServerContext* context,
                                                       const grpc::ByteBuffer* request, grpc::ByteBuffer* response) {
  return Handle(Method::kGetTable, HandleGetTable, kMaxInlineBytes, *context, *request, *response);
}

}  // namespace albtpu::server
