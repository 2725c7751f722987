#include "service/server/observe/call_log.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "service/server/ground/limits.h"

namespace albtpu::server {

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

}  // namespace albtpu::server
