// Answers to single calls that have been made and not been taken.
#pragma once

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <list>
#include <mutex>

#include "service/server/ground/limits.h"
#include "service/server/ground/repeated.h"
#include "service/server/observe/call_metrics.h"

namespace albtpu::server {

// gRPC holds an answer, with its request, until the caller has opened its window for it (HTTP/2, RFC 9113,
// 5.2): a caller who does not could have them pile up. Those that wait for longer than kMaxStreamIdle are
// dropped with DEADLINE_EXCEEDED, and, where there are many, for longer than kMaxUnreadWhenCrowded.
class UnreadAnswers {
 public:
  using Clock = std::chrono::steady_clock;

  // Counts those dropped in `metrics`.
  explicit UnreadAnswers(CallMetrics& metrics);

  // One of them, for as long as the object lives: up to the end of the call, while its context is there.
  class Answer {
   public:
    // Of a call that takes `bytes`, request and answer.
    Answer(UnreadAnswers& all, grpc::CallbackServerContext& context, std::size_t bytes);
    ~Answer();

    Answer(const Answer&) = delete;
    Answer& operator=(const Answer&) = delete;

   private:
    friend class UnreadAnswers;

    UnreadAnswers& all_;
    grpc::CallbackServerContext& context_;
    const std::size_t bytes_;
    const Clock::time_point made_ = Clock::now();
    bool dropped_ = false;
    std::list<Answer*>::iterator place_;
  };

  // Whether there is room for an answer of that many bytes more: no more than kMaxUnreadBytes are held.
  bool HaveRoomFor(std::size_t bytes) const { return bytes_ + bytes <= kMaxUnreadBytes; }

  // Drops those that are due. Is done every second.
  void DropUnread(Clock::time_point now);

 private:
  CallMetrics& metrics_;
  std::mutex mutex_;
  std::list<Answer*> answers_;  // The oldest first. Guarded by mutex_.
  std::atomic<std::size_t> bytes_ = 0;
  Repeated dropping_;  // Goes first.
};

}  // namespace albtpu::server
