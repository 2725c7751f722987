// A call of `StreamColumns`.
#pragma once

#include <grpcpp/grpcpp.h>

#include <mutex>

#include "service/server/table_catalog.h"
#include "service/server/workers.h"

namespace albtpu::server {

// One answer after the other. While one is made and sent, the request after it is received and waits: a
// stream holds two requests and an answer at most, however slowly its caller reads.
//
// Lives until the call is done. Has been admitted to `workers`, and leaves them then.
class ColumnStream final : public grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
 public:
  ColumnStream(const TableCatalog& catalog, Workers& workers, const grpc::CallbackServerContext& context);

 private:
  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnDone() override;

  // What can be done now: answer the request that waits, end the call, or nothing yet.
  void Proceed();
  void Answer();

  const TableCatalog& catalog_;
  Workers& workers_;
  const grpc::CallbackServerContext& context_;

  std::mutex mutex_;       // Guards those before the blank line.
  bool waiting_ = false;   // `next_` holds a request.
  bool read_all_ = false;  // There is no further request, or the caller has gone.
  bool busy_ = false;      // `current_` is being answered, or `answer_` sent.
  bool ended_ = false;

  grpc::ByteBuffer next_, current_, answer_;
};

}  // namespace albtpu::server
