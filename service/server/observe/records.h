// The records of a server's calls and reloads: log lines, and the metrics of each call.
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

#include "service/server/observe/log.h"
#include "service/server/observe/metrics.h"
#include "service/server/tables/live_tables.h"

namespace albtpu::server {

// Log lines that callers can cause, limited in number.
class CallLog {
 public:
  // Writes at most kMaxCallLinesPerSecond lines; the next written line says how many were left out before it.
  void Write(spdlog::level::level_enum level, const std::string& message, LogFields fields);

 private:
  using Clock = std::chrono::steady_clock;

  // Whether a line may be written now. If so, `left_out` is the number of lines left out before it.
  bool Admit(long& left_out);

  std::mutex mutex_;
  Clock::time_point second_begin_ = Clock::now();
  int lines_ = 0;
  long left_out_ = 0;
};

// The records of calls, and of callers that are refused.
struct Recorders {
  CallMetrics& metrics;
  AccessMetrics& access;
  SeaMetrics& seas;
  CallLog& log;
};

// The record of one call, made when the call begins. The log gets a line for each call that failed and for each stream
// and reload. Other successful calls appear in the metrics only: there may be tens of thousands a second.
class CallRecord {
 public:
  using Clock = std::chrono::steady_clock;

  CallRecord(const Recorders& recorders, Method method, grpc::CallbackServerContext& context);

  Clock::time_point begin() const { return begin_; }
  const RequestId& request_id() const { return request_id_; }

  // Counts an answer with pulses to a request that arrived, or in a stream began to be handled, at `requested`.
  void CountAnswer(const OutcomeTally& tally, Clock::time_point requested);

  // Called once, last, and before the call is finished in gRPC: after that the context may no longer exist. A caller
  // whose call failed also gets the id of the request (metadata x-request-id).
  void End(const grpc::Status& status) const;

 private:
  void WriteLine(const grpc::Status& status) const;

  const Recorders& recorders_;
  const Method method_;
  grpc::CallbackServerContext& context_;
  const RequestId request_id_;
  const Clock::time_point begin_ = Clock::now();
  std::size_t answers_ = 0;
  std::size_t pulses_ = 0;
};

// Logs one line about a reload. On failure it names files.
void LogReload(const LiveTables::ReloadResult& result);

}  // namespace albtpu::server
