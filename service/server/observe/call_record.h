// One call, as the metrics count it and the log tells it.
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <cstddef>

#include "service/server/ground/method.h"
#include "service/server/observe/access_metrics.h"
#include "service/server/observe/call_log.h"
#include "service/server/observe/call_metrics.h"
#include "service/server/observe/request_id.h"

namespace albtpu::server {

// Where the records of calls go, and of those who were not let in.
struct CallRecords {
  CallMetrics& metrics;
  AccessMetrics& access;
  CallLog& log;
};

// Made when a call begins. The log has a line of each call that failed and of each stream and reload; other
// calls that went well it leaves to the metrics: there may be ten thousands a second.
class CallRecord {
 public:
  using Clock = std::chrono::steady_clock;

  CallRecord(const CallRecords& records, Method method, grpc::CallbackServerContext& context);

  Clock::time_point begin() const { return begin_; }
  const RequestId& request_id() const { return request_id_; }

  // An answer is made, `asked` is when it was asked for.
  void CountAnswer(const OutcomeTally& tally, Clock::time_point asked);

  // Once, last, and before gRPC is told: after that the context may be gone. Whoever is told of a failure is
  // told the id of the request, too (metadata x-request-id).
  void End(const grpc::Status& status) const;

 private:
  void WriteLine(const grpc::Status& status) const;

  const CallRecords& records_;
  const Method method_;
  grpc::CallbackServerContext& context_;
  const RequestId request_id_;
  const Clock::time_point begin_ = Clock::now();
  std::size_t answers_ = 0;
  std::size_t pulses_ = 0;
};

}  // namespace albtpu::server
