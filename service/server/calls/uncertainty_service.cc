#include "service/server/calls/uncertainty_service.h"

#include <memory>
#include <optional>
#include <utility>

#include "service/server/calls/column_stream.h"
#include "service/server/ground/errors.h"
#include "service/server/ground/limits.h"
#include "service/server/tables/table_messages.h"

namespace albtpu::server {
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

grpc::ServerUnaryReactor* Fail(grpc::CallbackServerContext& context, CallRecord& record,
                               const grpc::Status& status) {
  grpc::ServerUnaryReactor* reactor = context.DefaultReactor();
  record.End(status);
  reactor->Finish(status);
  return reactor;
}

// Sends the answer unless too much is unread. `bytes` is the size of request and answer together.
grpc::ServerUnaryReactor* Deliver(UnreadAnswers& unread, grpc::CallbackServerContext& context,
                                  CallRecord& record, std::size_t bytes) {
  if (!unread.HasRoomFor(bytes)) return Fail(context, record, TooManyUnread());
  record.End(grpc::Status::OK);
  return new Delivery(unread, context, bytes);
}

// Runs the handler of a single call and records its answer.
grpc::Status RunHandler(CallRecord& record, MessageHandler handler, const TableCatalog& catalog,
                        const grpc::ByteBuffer& request, grpc::ByteBuffer& response) {
  const RequestScope scope(record.request_id());
  OutcomeTally tally;
  const grpc::Status status = handler(catalog, request, response, tally);
  if (status.ok()) record.CountAnswer(tally, record.begin());
  return status;
}

class RefusedStream final : public ByteStream {
 public:
  explicit RefusedStream(const grpc::Status& status) { Finish(status); }
  void OnDone() override { delete this; }
};

// A long request, which waits for a worker. The workers must have admitted it; its place is released at the end.
class LongCall final : public grpc::ServerUnaryReactor {
 public:
  LongCall(Workers& workers, UnreadAnswers& unread, const CallRecord& record,
           grpc::CallbackServerContext& context, MessageHandler handler,
           std::shared_ptr<const TableCatalog> catalog, const grpc::ByteBuffer& request,
           grpc::ByteBuffer& response)
      : workers_(workers), record_(record), catalog_(std::move(catalog)) {
    workers.Run([this, &unread, &context, handler, &request, &response] {
      const grpc::Status status = context.IsCancelled()
                                      ? grpc::Status::CANCELLED
                                      : RunHandler(record_, handler, *catalog_, request, response);
      record_.End(status);
      // Counts no bytes: its place among the long calls already bounds them.
      if (status.ok()) unread_.emplace(unread, context, 0);
      Finish(status);
    });
  }

 private:
  void OnDone() override {
    workers_.Release();
    delete this;
  }

  Workers& workers_;
  CallRecord record_;
  const std::shared_ptr<const TableCatalog> catalog_;
  std::optional<UnreadAnswers::Entry> unread_;
};

}  // namespace

grpc::ServerUnaryReactor* UncertaintyService::Handle(Method method, MessageHandler handler,
                                                     grpc::CallbackServerContext& context,
                                                     const grpc::ByteBuffer& request,
                                                     grpc::ByteBuffer& response) {
  CallRecord record(recorders_, method, context);
  if (!request.Valid()) return Fail(context, record, NotReceived(context));
  const std::shared_ptr<const TableCatalog> catalog = tables_.current();
  const std::size_t length = request.Length();
  if (length > kMaxInlineBytes) {
    if (!workers_.Admit()) return Fail(context, record, TooManyCalls());
    return new LongCall(workers_, unread_, record, context, handler, catalog, request, response);
  }
  if (!unread_.HasRoomFor(length)) return Fail(context, record, TooManyUnread());
  const grpc::Status status = RunHandler(record, handler, *catalog, request, response);
  if (!status.ok()) return Fail(context, record, status);
  return Deliver(unread_, context, record, length + response.Length());
}

grpc::ServerUnaryReactor* UncertaintyService::QueryPulses(grpc::CallbackServerContext* context,
                                                          const grpc::ByteBuffer* request,
                                                          grpc::ByteBuffer* response) {
  return Handle(Method::kQueryPulses, HandleQueryPulses, *context, *request, *response);
}

grpc::ServerUnaryReactor* UncertaintyService::QueryColumns(grpc::CallbackServerContext* context,
                                                           const grpc::ByteBuffer* request,
                                                           grpc::ByteBuffer* response) {
  return Handle(Method::kQueryColumns, HandleQueryColumns, *context, *request, *response);
}

ByteStream* UncertaintyService::StreamColumns(grpc::CallbackServerContext* context) {
  CallRecord record(recorders_, Method::kStreamColumns, *context);
  if (workers_.Admit()) return new ColumnStream(tables_.current(), workers_, record, *context);
  const grpc::Status refusal = TooManyCalls();
  record.End(refusal);
  return new RefusedStream(refusal);
}

grpc::ServerUnaryReactor* UncertaintyService::ListTables(grpc::CallbackServerContext* context,
                                                         const v1::ListTablesRequest* /*request*/,
                                                         v1::ListTablesResponse* response) {
  CallRecord record(recorders_, Method::kListTables, *context);
  const std::shared_ptr<const TableCatalog> catalog = tables_.current();
  for (const auto& entry : catalog->entries()) *response->add_tables() = WriteSummary(*entry);
  const absl::StatusOr<const TableCatalog::Entry*> default_entry = catalog->Find("");
  if (default_entry.ok()) response->set_default_table((*default_entry)->name);
  return Deliver(unread_, *context, record, response->ByteSizeLong());
}

grpc::ServerUnaryReactor* UncertaintyService::GetTable(grpc::CallbackServerContext* context,
                                                       const v1::GetTableRequest* request,
                                                       v1::GetTableResponse* response) {
  CallRecord record(recorders_, Method::kGetTable, *context);
  const std::shared_ptr<const TableCatalog> catalog = tables_.current();
  const absl::StatusOr<const TableCatalog::Entry*> entry = catalog->Find(request->table());
  if (!entry.ok()) return Fail(*context, record, ToGrpcStatus(entry.status()));
  *response->mutable_table() = WriteTableMessage(**entry);
  return Deliver(unread_, *context, record, response->ByteSizeLong());
}

}  // namespace albtpu::server
