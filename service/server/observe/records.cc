#include "service/server/observe/records.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "absl/strings/str_cat.h"
#include "service/server/ground/limits.h"

namespace albtpu::server {
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
  if (!status.ok() || method_ == Method::kStreamColumns || method_ == Method::kReloadTables) {
    WriteLine(status);
  }
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
  recorders_.log.Write(LevelOf(status.error_code()),
                       status.ok()
                           ? "call ended"
                           : absl::StrCat("call failed", has_message ? ": " : "", status.error_message()),
                       std::move(fields));
}

void LogReload(const LiveTables::ReloadResult& result) {
  if (!result.ok()) {
    spdlog::error("tables not reloaded, the previous tables stay in use: {}",
                  std::string(result.status().message()));
    return;
  }
  using Kind = TableCatalog::Change::Kind;
  const auto count = [&](Kind kind) {
    return std::count_if(result->begin(), result->end(),
                         [&](const auto& change) { return change.kind == kind; });
  };
  Log(spdlog::level::info, "tables reloaded",
      {{"loaded", count(Kind::kLoaded)}, {"kept", count(Kind::kKept)}, {"removed", count(Kind::kRemoved)}});
}

}  // namespace albtpu::server
