#include "service/server/observe/log.h"

#include <limits.h>
#include <poll.h>
#include <spdlog/sinks/base_sink.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "absl/random/random.h"
#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/time/time.h"
#include "service/printable_text.h"
#include "service/server/ground/limits.h"

namespace albtpu::server {
namespace {

// Longer lines are cut to this length, which a pipe that has room at all takes without blocking.
constexpr std::size_t kMaxLineBytes = PIPE_BUF;

// spdlog accepts only text. Through these, the formatter gets the other parts of the line that this thread logs.
thread_local const LogFields* line_fields = nullptr;
thread_local const RequestId* current_request = nullptr;

LogFields Fields() {
  LogFields fields = LogFields::object();
  if (current_request != nullptr) fields["request_id"] = current_request->text();
  if (line_fields != nullptr && line_fields->is_object()) fields.update(*line_fields);
  return fields;
}

std::string Text(const LogFields& fields) { return fields.dump(-1, ' ', false, LogFields::error_handler_t::replace); }

std::string JsonLine(const spdlog::details::log_msg& line, const std::string& message) {
  const spdlog::string_view_t level = spdlog::level::to_string_view(line.level);
  LogFields entry = {
      {"time", absl::FormatTime("%Y-%m-%dT%H:%M:%E3SZ", absl::FromChrono(line.time), absl::UTCTimeZone())},
      {"level", std::string(level.data(), level.size())},
      {"message", message}};
  entry.update(Fields());
  return Text(entry);
}

std::string TextLine(const spdlog::details::log_msg& line, const std::string& message) {
  std::string text = PrintableText(message);
  const LogFields fields = Fields();
  const char* separator = " [";
  for (const auto& [name, value] : fields.items()) {
    absl::StrAppend(&text, separator, name, "=",
                    value.is_string() ? PrintableText(value.get<std::string>()) : Text(value));
    separator = " ";
  }
  return absl::StrCat(std::string(line.logger_name.data(), line.logger_name.size()), ": ", text,
                      fields.empty() ? "" : "]");
}

class LineFormatter final : public spdlog::formatter {
 public:
  explicit LineFormatter(LogStyle style) : style_(style) {}

  void format(const spdlog::details::log_msg& line, spdlog::memory_buf_t& buffer) override {
    std::string message(line.payload.data(), line.payload.size());
    std::string text = Line(line, message);
    while (text.size() > kMaxLineBytes && !message.empty()) {
      message.resize(message.size() / 2);
      text = Line(line, message + " ...");
    }
    buffer.append(text.data(), text.data() + text.size());
  }

  std::unique_ptr<spdlog::formatter> clone() const override { return std::make_unique<LineFormatter>(style_); }

 private:
  std::string Line(const spdlog::details::log_msg& line, const std::string& message) const {
    return (style_ == LogStyle::kJson ? JsonLine(line, message) : TextLine(line, message)) + "\n";
  }

  const LogStyle style_;
};

class Sink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit Sink(int descriptor) : descriptor_(descriptor) {}

 private:
  void sink_it_(const spdlog::details::log_msg& line) override {
    if (left_out_ > 0 && HasRoom()) {
      const std::string text = absl::StrCat(left_out_, " lines were left out (the reader of the log did not keep up)");
      const LogFields* fields = std::exchange(line_fields, nullptr);
      const RequestId* request = std::exchange(current_request, nullptr);
      Write(spdlog::details::log_msg(line.logger_name, spdlog::level::warn, text));
      line_fields = fields;
      current_request = request;
      left_out_ = 0;
    }
    if (HasRoom()) return Write(line);
    ++left_out_;
  }

  // A pipe that has room takes kMaxLineBytes without blocking.
  bool HasRoom() const {
    pollfd state = {descriptor_, POLLOUT, 0};
    return poll(&state, 1, 0) == 1 && (state.revents & POLLOUT) != 0;
  }

  void Write(const spdlog::details::log_msg& line) {
    spdlog::memory_buf_t text;
    formatter_->format(line, text);
    // An error is ignored: if the log is closed or its disk is full, there is no place to report it.
    [[maybe_unused]] const ssize_t written = write(descriptor_, text.data(), text.size());
  }

  void flush_() override {}

  const int descriptor_;
  long left_out_ = 0;
};

std::string MakeId() {
  thread_local absl::BitGen random;
  return absl::StrCat(absl::Hex(absl::Uniform<std::uint64_t>(random), absl::kZeroPad16));
}

}  // namespace

std::shared_ptr<spdlog::sinks::sink> MakeLogSink(int descriptor) { return std::make_shared<Sink>(descriptor); }

std::unique_ptr<spdlog::formatter> MakeLogFormatter(LogStyle style) { return std::make_unique<LineFormatter>(style); }

void Log(spdlog::level::level_enum level, const std::string& message, const LogFields& fields) {
  line_fields = &fields;
  spdlog::log(level, spdlog::string_view_t(message));
  line_fields = nullptr;
}

const std::string& RequestId::text() const {
  if (!text_.empty()) return text_;
  const auto& metadata = context_.client_metadata();
  const auto sent = metadata.find(kMetadata);
  std::string_view text;
  if (sent != metadata.end()) text = {sent->second.data(), sent->second.size()};
  text_ = IsValid(text) ? std::string(text) : MakeId();
  return text_;
}

bool RequestId::IsValid(std::string_view text) {
  return !text.empty() && text.size() <= kMaxRequestIdBytes && std::all_of(text.begin(), text.end(), [](char c) {
    return absl::ascii_isalnum(c) || c == '.' || c == '_' || c == '-';
  });
}

RequestScope::RequestScope(const RequestId& request_id) : before_(std::exchange(current_request, &request_id)) {}

RequestScope::~RequestScope() { current_request = before_; }

namespace {

spdlog::level::level_enum LevelOf(grpc::StatusCode code) {
  switch (code) {
    case grpc::StatusCode::INTERNAL:
    case grpc::StatusCode::UNKNOWN:
    case grpc::StatusCode::DATA_LOSS:
      return spdlog::level::err;
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return spdlog::level::warn;
    default:
      return spdlog::level::info;
  }
}

}  // namespace

void CallLog::Write(spdlog::level::level_enum level, const std::string& message, LogFields fields) {
  long left_out = 0;
  if (!Admit(left_out)) return;
  if (left_out > 0) fields["lines_left_out"] = left_out;
  Log(level, message, fields);
}

bool CallLog::Admit(long& left_out) {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (now - second_begin_ >= std::chrono::seconds(1)) {
    second_begin_ = now;
    lines_ = 0;
  }
  if (lines_ == kMaxCallLinesPerSecond) {
    ++left_out_;
    return false;
  }
  ++lines_;
  left_out = std::exchange(left_out_, 0);
  return true;
}

CallRecord::CallRecord(const Recorders& recorders, Method method, grpc::CallbackServerContext& context)
    : recorders_(recorders), method_(method), context_(context), request_id_(context) {
  recorders.metrics.CountBegin(method);
}

void CallRecord::CountAnswer(const OutcomeTally& tally, Clock::time_point requested) {
  ++answers_;
  pulses_ += tally.pulses();
  recorders_.metrics.CountAnswer(method_, tally, Clock::now() - requested);
}

void CallRecord::End(const grpc::Status& status) const {
  recorders_.metrics.CountEnd(method_, status.error_code());
  if (!status.ok()) context_.AddTrailingMetadata(RequestId::kMetadata, request_id_.text());
  if (!status.ok() || method_ == Method::kStreamColumns || method_ == Method::kReloadTables) WriteLine(status);
}

void CallRecord::WriteLine(const grpc::Status& status) const {
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  LogFields fields = {{"method", Name(method_)},
                      {"code", CodeName(status.error_code())},
                      {"seconds", std::round(seconds * 1e6) / 1e6},
                      {"peer", context_.peer()}};
  if (method_ <= Method::kStreamColumns) {
    fields["answers"] = answers_;
    fields["pulses"] = pulses_;
  }
  const RequestScope scope(request_id_);
  const bool has_message = !status.error_message().empty();
  recorders_.log.Write(
      LevelOf(status.error_code()),
      status.ok() ? "call ended" : absl::StrCat("call failed", has_message ? ": " : "", status.error_message()),
      std::move(fields));
}

void LogReload(const LiveTables::ReloadResult& result) {
  if (!result.ok()) {
    spdlog::error("tables not reloaded, the previous tables stay in use: {}", std::string(result.status().message()));
    return;
  }
  using Kind = TableCatalog::Change::Kind;
  const auto count = [&](Kind kind) {
    return std::count_if(result->begin(), result->end(), [&](const auto& change) { return change.kind == kind; });
  };
  Log(spdlog::level::info, "tables reloaded",
      {{"loaded", count(Kind::kLoaded)}, {"kept", count(Kind::kKept)}, {"removed", count(Kind::kRemoved)}});
}

}  // namespace albtpu::server
