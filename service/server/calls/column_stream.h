// A call of `StreamColumns`.
#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <mutex>

#include "service/server/ground/idle_watch.h"
#include "service/server/ground/workers.h"
#include "service/server/observe/call_record.h"
#include "service/server/tables/table_catalog.h"

namespace albtpu::server {

// One answer after the other. While one is made and sent, the request after it is received and waits: a
// stream holds two requests and an answer at most, however slowly its caller reads.
//
// Where nothing moves for kMaxStreamIdle the call ends: with DEADLINE_EXCEEDED if it is the next request that
// does not come, else, its caller reads no more, as if cancelled.
//
// Lives until the call is done. Has been admitted to `workers`, and leaves them then.
class ColumnStream final : public grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
 public:
  // All answers come from `catalog`.
  ColumnStream(std::shared_ptr<const TableCatalog> catalog, Workers& workers, const CallRecord& record,
               grpc::CallbackServerContext& context);

 private:
  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnDone() override;

  // What can be done now: answer the request that waits, end the call, or nothing yet.
  void Proceed();
  void Answer();
  grpc::Status MakeAnswer();
  void End(const grpc::Status& status);
  void EndIdle();

  const std::shared_ptr<const TableCatalog> catalog_;
  Workers& workers_;
  CallRecord record_;  // For one thread at a time: that which answers, or that which ends the call.
  grpc::CallbackServerContext& context_;

  std::mutex mutex_;       // Guards those before the blank line.
  bool waiting_ = false;   // `next_` holds a request.
  bool read_all_ = false;  // There is no further request, or the caller has gone.
  bool busy_ = false;      // `current_` is being answered, or `answer_` sent.
  bool ended_ = false;

  grpc::ByteBuffer next_, current_, answer_;
  CallRecord::Clock::time_point asked_;  // When `current_` had its turn.
  IdleWatch idle_watch_;                 // Goes first, and calls nothing from then on.
};

}  // namespace albtpu::server
