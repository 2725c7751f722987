// Lines of the log about calls, as many as a log can bear.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "service/server/observe/log.h"

namespace albtpu::server {

class CallLog {
 public:
  // At most kMaxCallLinesPerSecond; the next line that is written says how many were left out before it.
  void Write(spdlog::level::level_enum level, const std::string& message, LogFields fields);

 private:
  using Clock = std::chrono::steady_clock;

  // Whether a line may be written now; then with the number of those left out before it.
  bool Admit(long& left_out);

  std::mutex mutex_;
  Clock::time_point second_begin_ = Clock::now();
  int lines_ = 0;
  long left_out_ = 0;
};

}  // namespace albtpu::server
