// The progress of a long computation and the time left, on standard error.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace albtpu::programs {

// On a terminal a bar, which is redrawn in place and erased at the end; elsewhere a line every ten seconds.
class Progress {
 public:
  Progress(std::string label, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Reach(std::size_t done);

 private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  std::size_t total_;
  bool terminal_;
  Clock::time_point start_, last_shown_;
};

}  // namespace albtpu::programs
