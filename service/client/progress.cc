#include "service/client/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace albtpu::client {
namespace {

constexpr std::chrono::milliseconds kRedraw{200};
constexpr std::chrono::seconds kLineEvery{10};
constexpr int kBarWidth = 30;

}  // namespace

Progress::Progress(std::string label, std::uint64_t total)
    : label_(std::move(label)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_shown_(start_) {}

void Progress::Reach(std::uint64_t done) {
  const Clock::time_point now = Clock::now();
  if (total_ == 0 || done == 0) return;
  if (now - last_shown_ < (terminal_ ? Clock::duration(kRedraw) : Clock::duration(kLineEvery))) return;
  last_shown_ = now;
  const double fraction = std::min(1.0, static_cast<double>(done) / static_cast<double>(total_));
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double seconds_left = seconds * (1 - fraction) / fraction;
  if (terminal_) {
    const int filled = static_cast<int>(fraction * kBarWidth);
    const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
    std::fprintf(stderr, "\r%s [%s] %3.0f %%, %.0f s left \033[K", label_.c_str(), bar.c_str(),
                 100 * fraction, seconds_left);
    drawn_ = true;
  } else {
    std::fprintf(stderr, "albtpu-query: %s: %.0f %%, %.0f s left\n", label_.c_str(), 100 * fraction,
                 seconds_left);
  }
}

Progress::~Progress() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

}  // namespace albtpu::client
