#include "service/server/calls/uncertainty_service.h"

#include <memory>
#include <optional>
#include <utility>

#include "service/server/calls/column_stream.h"
#include "service/server/ground/limits.h"
#include "service/server/ground/status.h"
#include "service/server/tables/table_messages.h"

namespace albtpu::server {
namespace {

using ByteStream = grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>;

grpc::Status TooManyCalls() {
  return ToGrpcStatus(absl::ResourceExhaustedError(
      "the server has as many long calls under way as it takes: wait, and try again"));
}

// gRPC has a request answered, too, that did not arrive whole.
grpc::Status NotReceived(const grpc::CallbackServerContext& context) {
  if (context.IsCancelled()) return grpc::Status::CANCELLED;
  return ToGrpcStatus(absl::UnavailableError("the request did not arrive whole: send it again"));
}

grpc::Status TooManyUnread() {
  return ToGrpcStatus(absl::ResourceExhaustedError(
      "answers that callers have not read take as much memory as they may: read yours, wait, and try again"));
}

// An answer that is made, on its way to the caller.
class AnsweredCall final : public grpc::ServerUnaryReactor {
 public:
  AnsweredCall(UnreadAnswers& unread, grpc::CallbackServerContext& context, std::size_t bytes)
      : answer_(unread, context, bytes) {
    Finish(grpc::Status::OK);
  }

 private:
  void OnDone() override { delete this; }

  // As gRPC has it for its own reactors: OnDone() is short, and handing it over to a thread of its own would
  // take a quarter of a short call.
  bool InternalInlineable() override { return true; }

  const UnreadAnswers::Answer answer_;
};

grpc::ServerUnaryReactor* Failed(grpc::CallbackServerContext& context, CallRecord& record,
                                 const grpc::Status& status) {
  grpc::ServerUnaryReactor* reactor = context.DefaultReactor();
  record.End(status);
  reactor->Finish(status);
  return reactor;
}

// `bytes`: of request and answer.
grpc::ServerUnaryReactor* Answered(UnreadAnswers& unread, grpc::CallbackServerContext& context,
                                   CallRecord& record, std::size_t bytes) {
  if (!unread.HaveRoomFor(bytes)) return Failed(context, record, TooManyUnread());
  record.End(grpc::Status::OK);
  return new AnsweredCall(unread, context, bytes);
}

// The only answer of `record`'s call.
grpc::Status OneAnswer(CallRecord& record, ByteAnswer answer, const TableCatalog& catalog,
                       const grpc::ByteBuffer& request, grpc::ByteBuffer& response) {
  const RequestScope scope(record.request_id());
  OutcomeTally tally;
  const grpc::Status status = answer(catalog, request, response, tally);
  if (status.ok()) record.CountAnswer(tally, record.begin());
  return status;
}

class RefusedStream final : public ByteStream {
 public:
  explicit RefusedStream(const grpc::Status& status) { Finish(status); }
  void OnDone() override { delete this; }
};

// A long request, which waits for a worker. Has been admitted to the workers, and leaves them when done.
class LongCall final : public grpc::ServerUnaryReactor {
 public:
  LongCall(Workers& workers, UnreadAnswers& unread, const CallRecord& record,
           grpc::CallbackServerContext& context, ByteAnswer answer,
           std::shared_ptr<const TableCatalog> catalog, const grpc::ByteBuffer& request,
           grpc::ByteBuffer& response)
      : workers_(workers), record_(record), catalog_(std::move(catalog)) {
    workers.Run([this, &unread, &context, answer, &request, &response] {
      const grpc::Status status = context.IsCancelled()
                                      ? grpc::Status::CANCELLED
                                      : OneAnswer(record_, answer, *catalog_, request, response);
      record_.End(status);
      if (status.ok())
        unread_.emplace(unread, context, 0);  // Its place among the long calls bounds its bytes.
      Finish(status);
    });
  }

 private:
  void OnDone() override {
    workers_.Dismiss();
    delete this;
  }

  Workers& workers_;
  CallRecord record_;
  const std::shared_ptr<const TableCatalog> catalog_;
  std::optional<UnreadAnswers::Answer> unread_;
};

}  // namespace

grpc::ServerUnaryReactor* UncertaintyService::Answer(Method method, ByteAnswer answer,
                                                     grpc::CallbackServerContext& context,
                                                     const grpc::ByteBuffer& request,
                                                     grpc::ByteBuffer& response) {
  CallRecord record(records_, method, context);
  if (!request.Valid()) return Failed(context, record, NotReceived(context));
  const std::shared_ptr<const TableCatalog> catalog = tables_.current();
  const std::size_t length = request.Length();
  if (length > kMaxInlineBytes) {
    if (!workers_.Admit()) return Failed(context, record, TooManyCalls());
    return new LongCall(workers_, unread_, record, context, answer, catalog, request, response);
  }
  if (!unread_.HaveRoomFor(length)) return Failed(context, record, TooManyUnread());
  const grpc::Status status = OneAnswer(record, answer, *catalog, request, response);
  if (!status.ok()) return Failed(context, record, status);
  return Answered(unread_, context, record, length + response.Length());
}

grpc::ServerUnaryReactor* UncertaintyService::QueryPulses(grpc::CallbackServerContext* context,
                                                          const grpc::ByteBuffer* request,
                                                          grpc::ByteBuffer* response) {
  return Answer(Method::kQueryPulses, AnswerQueryPulses, *context, *request, *response);
}

grpc::ServerUnaryReactor* UncertaintyService::QueryColumns(grpc::CallbackServerContext* context,
                                                           const grpc::ByteBuffer* request,
                                                           grpc::ByteBuffer* response) {
  return Answer(Method::kQueryColumns, AnswerQueryColumns, *context, *request, *response);
}

ByteStream* UncertaintyService::StreamColumns(grpc::CallbackServerContext* context) {
  CallRecord record(records_, Method::kStreamColumns, *context);
  if (workers_.Admit()) return new ColumnStream(tables_.current(), workers_, record, *context);
  const grpc::Status refusal = TooManyCalls();
  record.End(refusal);
  return new RefusedStream(refusal);
}

grpc::ServerUnaryReactor* UncertaintyService::ListTables(grpc::CallbackServerContext* context,
                                                         const v1::ListTablesRequest* /*request*/,
                                                         v1::ListTablesResponse* response) {
  CallRecord record(records_, Method::kListTables, *context);
  const std::shared_ptr<const TableCatalog> catalog = tables_.current();
  for (const auto& entry : catalog->entries()) *response->add_tables() = WriteSummary(*entry);
  const absl::StatusOr<const TableCatalog::Entry*> default_entry = catalog->Find("");
  if (default_entry.ok()) response->set_default_table((*default_entry)->name);
  return Answered(unread_, *context, record, response->ByteSizeLong());
}

grpc::ServerUnaryReactor* UncertaintyService::GetTable(grpc::CallbackServerContext* context,
                                                       const v1::GetTableRequest* request,
                                                       v1::GetTableResponse* response) {
  CallRecord record(records_, Method::kGetTable, *context);
  const std::shared_ptr<const TableCatalog> catalog = tables_.current();
  const absl::StatusOr<const TableCatalog::Entry*> entry = catalog->Find(request->table());
  if (!entry.ok()) return Failed(*context, record, ToGrpcStatus(entry.status()));
  *response->mutable_table() = WriteTableMessage(**entry);
  return Answered(unread_, *context, record, response->ByteSizeLong());
}

}  // namespace albtpu::server
