#include "programs/generate/progress.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace albtpu::programs {
namespace {

constexpr std::chrono::milliseconds kRedraw(100);
constexpr std::chrono::seconds kPlainLine(10);
constexpr std::size_t kBarWidth = 30;

}  // namespace

Progress::Progress(std::string label, std::size_t total)
    : label_(std::move(label)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_shown_(start_) {}

Progress::~Progress() {
  if (terminal_) std::fprintf(stderr, "\r\033[K");
}

void Progress::Reach(std::size_t done) {
  const Clock::time_point now = Clock::now();
  if (done == 0 || now - last_shown_ < (terminal_ ? Clock::duration(kRedraw) : Clock::duration(kPlainLine)))
    return;
  last_shown_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double left = elapsed * static_cast<double>(total_ - done) / static_cast<double>(done);
  if (terminal_) {
    const std::string bar(kBarWidth * done / total_, '#');
    std::fprintf(stderr, "\r%s [%-*s] %zu of %zu, %.0f s left\033[K", label_.c_str(),
                 static_cast<int>(kBarWidth), bar.c_str(), done, total_, left);
  } else {
    std::fprintf(stderr, "%s: %zu of %zu, %.0f s left\n", label_.c_str(), done, total_, left);
  }
}

}  // namespace albtpu::programs
