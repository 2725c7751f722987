// The log (lines for people or JSON objects for machines, with the id of their request), and the records of calls and
// reloads, which feed log and metrics.
#pragma once

#include <grpcpp/grpcpp.h>
#include <spdlog/formatter.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "service/server/observe/metrics.h"
#include "service/server/tables/table_catalog.h"

namespace albtpu::server {

enum class LogStyle {
  kText,  // albtpu-serve: tables reloaded [loaded=1]
  kJson,  // {"time":"2024-05-01T12:00:00.000Z","level":"info","message":"tables reloaded","loaded":1}
};

// Formats log lines in `style`.
std::unique_ptr<spdlog::formatter> MakeLogFormatter(LogStyle style);

// Writes lines to `descriptor` and never blocks: lines for which there is no room, because the reader has stopped, are
// left out, and a later line says how many. The log delays no answer.
std::shared_ptr<spdlog::sinks::sink> MakeLogSink(int descriptor);

// Logs a line with fields, a flat object. spdlog::info and similar functions log lines without fields.
using LogFields = nlohmann::ordered_json;
void Log(spdlog::level::level_enum level, const std::string& message, const LogFields& fields);

// The id of a call in the log: its metadata `x-request-id` if that is valid, otherwise 16 random hexadecimal digits.
// It is read or made on first use, because most calls are never logged.
class RequestId {
 public:
  static constexpr char kMetadata[] = "x-request-id";

  explicit RequestId(const grpc::CallbackServerContext& context) : context_(context) {}

  // Always the same text. Not thread-safe.
  const std::string& text() const;

  // 1 to 64 letters, digits, dots, underscores and hyphens.
  static bool IsValid(std::string_view text);

 private:
  const grpc::CallbackServerContext& context_;
  mutable std::string text_;
};

// During its life, all lines that its thread logs carry `request_id`, which must outlive it.
class RequestScope {
 public:
  explicit RequestScope(const RequestId& request_id);
  ~RequestScope();
  RequestScope(const RequestScope&) = delete;
  RequestScope& operator=(const RequestScope&) = delete;

 private:
  const RequestId* before_;
};

// The records of a server's calls and reloads: log lines, and the metrics of each call.

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
  WaterMetrics& waters;
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
