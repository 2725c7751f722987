#include "service/server/uncertainty_service.h"

#include "service/server/column_stream.h"
#include "service/server/limits.h"
#include "service/server/status.h"
#include "service/server/table_messages.h"

namespace albtpu::server {
namespace {

using ByteStream = grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>;

grpc::Status TooManyCalls() {
  return grpc::Status(grpc::StatusCode::RESOURCE_EXHAUSTED,
                      "the server has as many long calls under way as it takes: wait, and try again");
}

grpc::ServerUnaryReactor* Finished(grpc::CallbackServerContext& context, const grpc::Status& status) {
  grpc::ServerUnaryReactor* reactor = context.DefaultReactor();
  reactor->Finish(status);
  return reactor;
}

class RefusedStream final : public ByteStream {
 public:
  RefusedStream() { Finish(TooManyCalls()); }
  void OnDone() override { delete this; }
};

// A long request, which waits for a worker. Has been admitted to the workers, and leaves them when done.
class LongCall final : public grpc::ServerUnaryReactor {
 public:
  LongCall(Workers& workers, const grpc::CallbackServerContext& context, ByteAnswer answer,
           const TableCatalog& catalog, const grpc::ByteBuffer& request, grpc::ByteBuffer& response)
      : workers_(workers) {
    workers.Run([this, &context, answer, &catalog, &request, &response] {
      Finish(context.IsCancelled() ? grpc::Status::CANCELLED : answer(catalog, request, response));
    });
  }

 private:
  void OnDone() override {
    workers_.Dismiss();
    delete this;
  }

  Workers& workers_;
};

}  // namespace

grpc::ServerUnaryReactor* UncertaintyService::Answer(ByteAnswer answer, grpc::CallbackServerContext& context,
                                                     const grpc::ByteBuffer& request,
                                                     grpc::ByteBuffer& response) {
  if (request.Length() <= kMaxInlineBytes) {
    return Finished(context, answer(catalog_, request, response));
  }
  if (!workers_.Admit()) return Finished(context, TooManyCalls());
  return new LongCall(workers_, context, answer, catalog_, request, response);
}

grpc::ServerUnaryReactor* UncertaintyService::QueryPulses(grpc::CallbackServerContext* context,
                                                          const grpc::ByteBuffer* request,
                                                          grpc::ByteBuffer* response) {
  return Answer(AnswerQueryPulses, *context, *request, *response);
}

grpc::ServerUnaryReactor* UncertaintyService::QueryColumns(grpc::CallbackServerContext* context,
                                                           const grpc::ByteBuffer* request,
                                                           grpc::ByteBuffer* response) {
  return Answer(AnswerQueryColumns, *context, *request, *response);
}

ByteStream* UncertaintyService::StreamColumns(grpc::CallbackServerContext* context) {
  if (!workers_.Admit()) return new RefusedStream();
  return new ColumnStream(catalog_, workers_, *context);
}

grpc::ServerUnaryReactor* UncertaintyService::ListTables(grpc::CallbackServerContext* context,
                                                         const v1::ListTablesRequest* /*request*/,
                                                         v1::ListTablesResponse* response) {
  for (const TableCatalog::Entry& entry : catalog_.entries()) *response->add_tables() = WriteSummary(entry);
  const absl::StatusOr<const TableCatalog::Entry*> default_entry = catalog_.Find("");
  if (default_entry.ok()) response->set_default_table((*default_entry)->name);
  return Finished(*context, grpc::Status::OK);
}

grpc::ServerUnaryReactor* UncertaintyService::GetTable(grpc::CallbackServerContext* context,
                                                       const v1::GetTableRequest* request,
                                                       v1::GetTableResponse* response) {
  const absl::StatusOr<const TableCatalog::Entry*> entry = catalog_.Find(request->table());
  if (!entry.ok()) return Finished(*context, ToGrpcStatus(entry.status()));
  *response->mutable_table() = WriteTableMessage(**entry);
  return Finished(*context, grpc::Status::OK);
}

}  // namespace albtpu::server
