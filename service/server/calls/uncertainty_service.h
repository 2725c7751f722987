// The methods of albtpu.v1.UncertaintyService, which uncertainty_service.proto documents, and the watch over answers
// that callers do not read.
#pragma once

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <utility>

#include "albtpu/v1/uncertainty_service.grpc.pb.h"
#include "service/server/calls/query_rows.h"
#include "service/server/calls/sea_tables.h"
#include "service/server/calls/water_shares.h"
#include "service/server/ground/limits.h"
#include "service/server/ground/periodic_task.h"
#include "service/server/observe/log.h"
#include "service/server/observe/metrics.h"
#include "service/server/tables/table_catalog.h"

namespace albtpu::server {

// Answers to single calls that have been sent to gRPC but not yet read by their callers.

// gRPC holds an answer, with its request, until the caller has opened its flow control window for it (HTTP/2, RFC 9113,
// 5.2). A caller that does not do so could make answers accumulate. Answers that wait longer than `limit` are
// therefore dropped with DEADLINE_EXCEEDED; when there are many, so are those that wait longer than
// kMaxUnreadTimeWhenCrowded.
class UnreadAnswers {
 public:
  using Clock = std::chrono::steady_clock;

  // Counts the dropped answers in `metrics`.
  UnreadAnswers(CallMetrics& metrics, Clock::duration limit);

  // One unread answer. Exists until the end of the call, while its context exists.
  class Entry {
   public:
    // `bytes` is the size of request and answer together.
    Entry(UnreadAnswers& all, grpc::CallbackServerContext& context, std::size_t bytes);
    ~Entry();

    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;

   private:
    friend class UnreadAnswers;

    UnreadAnswers& all_;
    grpc::CallbackServerContext& context_;
    const std::size_t bytes_;
    const Clock::time_point made_ = Clock::now();
    bool dropped_ = false;
    std::list<Entry*>::iterator place_;
  };

  // Whether another answer of that size fits into kMaxUnreadBytes.
  bool HasRoomFor(std::size_t bytes) const { return bytes_ + bytes <= kMaxUnreadBytes; }

  // Drops the answers that have waited too long. Runs every second.
  void DropUnread(Clock::time_point now);

 private:
  CallMetrics& metrics_;
  const Clock::duration limit_;
  std::mutex mutex_;
  std::list<Entry*> entries_;  // The oldest first. Guarded by mutex_.
  std::atomic<std::size_t> bytes_ = 0;
  PeriodicTask dropping_;  // Last, so that it is destroyed first.
};

// Messages are received and sent as bytes: a worker parses and serializes those with many pulses.
using UncertaintyServiceOfBytes = v1::UncertaintyService::WithRawCallbackMethod_QueryPulses<
    v1::UncertaintyService::WithRawCallbackMethod_QueryColumns<
        v1::UncertaintyService::WithRawCallbackMethod_StreamColumns<
            v1::UncertaintyService::WithRawCallbackMethod_QueryBudget<
                v1::UncertaintyService::WithRawCallbackMethod_ListTables<
                    v1::UncertaintyService::WithRawCallbackMethod_GetTable<
                        v1::UncertaintyService::WithRawCallbackMethod_CompileSea<v1::UncertaintyService::Service>>>>>>>;

class UncertaintyService final : public UncertaintyServiceOfBytes {
 public:
  // `tables` and `recorders` must outlive the service. Streams whose callers are idle and unread answers end
  // after `max_stream_idle`.
  UncertaintyService(const LiveTables& tables, const Recorders& recorders, std::chrono::seconds max_stream_idle)
      : tables_(tables),
        recorders_(recorders),
        max_stream_idle_(max_stream_idle),
        unread_(recorders.metrics, max_stream_idle),
        seas_(recorders.seas, recorders.log),
        waters_(recorders.waters, recorders.log) {}

  // The server is about to stop: streams give their callers time to read the last answers before they end.
  void Drain() { draining_ = true; }

  grpc::ServerUnaryReactor* QueryPulses(grpc::CallbackServerContext* context, const grpc::ByteBuffer* request,
                                        grpc::ByteBuffer* response) override;
  grpc::ServerUnaryReactor* QueryColumns(grpc::CallbackServerContext* context, const grpc::ByteBuffer* request,
                                         grpc::ByteBuffer* response) override;
  grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>* StreamColumns(
      grpc::CallbackServerContext* context) override;
  grpc::ServerUnaryReactor* QueryBudget(grpc::CallbackServerContext* context, const grpc::ByteBuffer* request,
                                        grpc::ByteBuffer* response) override;
  grpc::ServerUnaryReactor* ListTables(grpc::CallbackServerContext* context, const grpc::ByteBuffer* request,
                                       grpc::ByteBuffer* response) override;
  grpc::ServerUnaryReactor* GetTable(grpc::CallbackServerContext* context, const grpc::ByteBuffer* request,
                                     grpc::ByteBuffer* response) override;
  grpc::ServerUnaryReactor* CompileSea(grpc::CallbackServerContext* context, const grpc::ByteBuffer* request,
                                       grpc::ByteBuffer* response) override;

 private:
  class LongCall;

  // Handles requests up to `inline_bytes` at once, unless their sea or water is to be compiled first; others on a
  // worker.
  grpc::ServerUnaryReactor* Handle(Method method, MessageHandler handler, std::size_t inline_bytes,
                                   grpc::CallbackServerContext& context, const grpc::ByteBuffer& request,
                                   grpc::ByteBuffer& response);

  const LiveTables& tables_;
  const Recorders& recorders_;
  const std::chrono::seconds max_stream_idle_;
  std::atomic<bool> draining_ = false;
  Workers workers_;
  UnreadAnswers unread_;
  SeaTables seas_;
  WaterShares waters_;
};

}  // namespace albtpu::server
