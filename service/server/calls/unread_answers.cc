#include "service/server/calls/unread_answers.h"

#include <grpc/grpc.h>

#include <vector>

namespace albtpu::server {

UnreadAnswers::UnreadAnswers(CallMetrics& metrics, Clock::duration limit)
    : metrics_(metrics),
      limit_(limit),
      dropping_(std::chrono::seconds(1), [this] { DropUnread(Clock::now()); }) {}

UnreadAnswers::Entry::Entry(UnreadAnswers& all, grpc::CallbackServerContext& context, std::size_t bytes)
    : all_(all), context_(context), bytes_(bytes) {
  all_.bytes_ += bytes_;
  const std::lock_guard lock(all_.mutex_);
  place_ = all_.entries_.insert(all_.entries_.end(), this);
}

UnreadAnswers::Entry::~Entry() {
  all_.bytes_ -= bytes_;
  const std::lock_guard lock(all_.mutex_);
  all_.entries_.erase(place_);
}

void UnreadAnswers::DropUnread(Clock::time_point now) {
  // Calls are cancelled after the lock is released, because gRPC may do other work while it cancels. Until then a
  // reference keeps each call alive.
  std::vector<grpc_call*> calls;
  {
    const std::lock_guard lock(mutex_);
    const Clock::duration limit =
        bytes_ > kMaxUnreadBytes / 2 ? Clock::duration(kMaxUnreadTimeWhenCrowded) : limit_;
    for (Entry* entry : entries_) {
      if (now - entry->made_ < limit) break;
      if (entry->dropped_) continue;
      entry->dropped_ = true;
      grpc_call_ref(calls.emplace_back(entry->context_.c_call()));
    }
  }
  for (grpc_call* call : calls) {
    metrics_.CountUnread();  // Before the caller can notice.
    grpc_call_cancel_with_status(call, GRPC_STATUS_DEADLINE_EXCEEDED,
                                 "the answer was not read in time; read answers as they arrive", nullptr);
    grpc_call_unref(call);
  }
}

}  // namespace albtpu::server
