// A call of `StreamColumns`, from its first request to its end.
#pragma once

#include <grpcpp/alarm.h>
#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>

#include "service/server/calls/sea_request.h"
#include "service/server/ground/periodic_task.h"
#include "service/server/observe/log.h"
#include "service/server/tables/table_catalog.h"

namespace albtpu::server {

// Handles one request after the other. While an answer is computed and sent, the next request is received and waits: a
// stream holds at most two requests and one answer, however slowly its caller reads.
//
// When the server waits for the caller for `max_idle`, the call ends: with DEADLINE_EXCEEDED if the next request does
// not arrive, as if cancelled if the caller does not read its answer. The time in which an answer waits for a worker or
// is computed does not count.
//
// When the server is draining, the status follows the last answer after kTimeToReadAnswers.
//
// Deletes itself when the call is done. `workers` must have admitted the call; its place is then released.
class ColumnStream final : public grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
 public:
  // Uses `catalog` for all answers without a sea. `seas` and `draining` must outlive the call.
  ColumnStream(std::shared_ptr<const TableCatalog> catalog, SeaTables& seas, Workers& workers, const CallRecord& record,
               grpc::CallbackServerContext& context, std::chrono::seconds max_idle, const std::atomic<bool>& draining);

 private:
  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnDone() override;

  // Does what is possible now: handles the waiting request, ends the call, or does nothing yet.
  void Proceed();
  // `compiled` is the table of the request's sea, if it had to be compiled.
  void HandleRequest(std::shared_ptr<const ServedTable> compiled);
  grpc::Status RunHandler(AnswerSources& sources);
  // Handles the request again when its sea is compiled.
  void AwaitTable(const WantedTable& wanted);
  void Fail(const grpc::Status& status);
  void End(const grpc::Status& status);
  void EndIdle();

  const std::shared_ptr<const TableCatalog> catalog_;
  SeaTables& seas_;
  Workers& workers_;
  CallRecord record_;  // Used by one thread at a time: the one that handles a request or ends the call.
  grpc::CallbackServerContext& context_;
  const std::chrono::seconds max_idle_;
  const std::atomic<bool>& draining_;

  std::mutex mutex_;       // Guards the members up to the blank line.
  bool waiting_ = false;   // `next_` holds a request.
  bool read_all_ = false;  // No further request will arrive, or the caller has disconnected.
  bool busy_ = false;      // `current_` is being handled, or `answer_` is being sent.
  bool ended_ = false;

  grpc::ByteBuffer next_, current_, answer_;
  CallRecord::Clock::time_point current_begin_;  // When the server turned to `current_`.
  grpc::Alarm end_alarm_;
  IdleWatch idle_watch_;  // Last, so that it is destroyed first and calls nothing afterwards.
};

}  // namespace albtpu::server
