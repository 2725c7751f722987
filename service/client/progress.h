// How far a long work is, for people, on standard error.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace albtpu::client {

// On a terminal a bar with the time left, redrawn in place and wiped at the end. Elsewhere a plain line every
// ten seconds, so that short works say nothing and logs stay short.
class Progress {
 public:
  // `total` in any unit; 0 when it is not known, and then nothing is shown.
  Progress(std::string label, std::uint64_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Reach(std::uint64_t done);

 private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  std::uint64_t total_;
  bool terminal_;
  Clock::time_point start_;
  Clock::time_point last_shown_;
  bool drawn_ = false;
};

}  // namespace albtpu::client
