// Answers to single calls that have been sent to gRPC but not yet read by their callers.
#pragma once

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <list>
#include <mutex>

#include "service/server/ground/limits.h"
#include "service/server/ground/periodic_task.h"
#include "service/server/observe/metrics.h"

namespace albtpu::server {

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

}  // namespace albtpu::server
