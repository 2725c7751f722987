#include "service/server/calls/unread_answers.h"

#include <grpc/grpc.h>

#include <vector>

namespace albtpu::server {

UnreadAnswers::UnreadAnswers(CallMetrics& metrics)
    : metrics_(metrics), dropping_(std::chrono::seconds(1), [this] { DropUnread(Clock::now()); }) {}

UnreadAnswers::Answer::Answer(UnreadAnswers& all, grpc::CallbackServerContext& context, std::size_t bytes)
    : all_(all), context_(context), bytes_(bytes) {
  all_.bytes_ += bytes_;
  const std::lock_guard lock(all_.mutex_);
  place_ = all_.answers_.insert(all_.answers_.end(), this);
}

UnreadAnswers::Answer::~Answer() {
  all_.bytes_ -= bytes_;
  const std::lock_guard lock(all_.mutex_);
  all_.answers_.erase(place_);
}

void UnreadAnswers::DropUnread(Clock::time_point now) {
  // Calls are cancelled when the lock is open: gRPC may do other work at that occasion. Until then they are
  // held.
  std::vector<grpc_call*> calls;
  {
    const std::lock_guard lock(mutex_);
    const Clock::duration most = bytes_ > kMaxUnreadBytes / 2 ? Clock::duration(kMaxUnreadWhenCrowded)
                                                              : Clock::duration(kMaxStreamIdle);
    for (Answer* answer : answers_) {
      if (now - answer->made_ < most) break;
      if (answer->dropped_) continue;
      answer->dropped_ = true;
      grpc_call_ref(calls.emplace_back(answer->context_.c_call()));
    }
  }
  for (grpc_call* call : calls) {
    metrics_.CountUnread();  // Before its caller can know.
    grpc_call_cancel_with_status(call, GRPC_STATUS_DEADLINE_EXCEEDED,
                                 "the answer was not read: ask when you can take what you ask for", nullptr);
    grpc_call_unref(call);
  }
}

}  // namespace albtpu::server
