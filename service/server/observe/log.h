// The log: lines for people, or JSON objects for machines, with the id of the request that they belong to.
#pragma once

#include <grpcpp/grpcpp.h>
#include <spdlog/formatter.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

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

}  // namespace albtpu::server
