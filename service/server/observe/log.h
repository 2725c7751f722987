// The log: lines for people, or JSON objects for machines.
#pragma once

#include <spdlog/formatter.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "service/server/observe/request_id.h"

namespace albtpu::server {

enum class LogStyle {
  kText,  // albtpu-serve: tables reloaded [loaded=1]
  kJson,  // {"time":"2024-05-01T12:00:00.000Z","level":"info","message":"tables reloaded","loaded":1}
};

// How the log writes lines from now on.
std::unique_ptr<spdlog::formatter> MakeLogFormatter(LogStyle style);

// Writes lines to `descriptor` and never waits: what a reader that has stopped would make the server wait for
// is left out, and once there is room a line says how many were. No answer is late because of the log.
std::shared_ptr<spdlog::sinks::sink> MakeLogSink(int descriptor);

// A line with fields, a flat object; spdlog::info and its like write lines without.
using LogFields = nlohmann::ordered_json;
void Log(spdlog::level::level_enum level, const std::string& message, const LogFields& fields);

// While it lives, all lines that its thread logs carry `request_id`, which must outlive it.
class RequestScope {
 public:
  explicit RequestScope(const RequestId& request_id);
  ~RequestScope();
  RequestScope(const RequestScope&) = delete;
  RequestScope& operator=(const RequestScope&) = delete;

 private:
  const RequestId* before_;
};

}  // namespace albtpu::server
