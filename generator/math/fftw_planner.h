// FFTW's planner is not thread-safe, whatever is planned; executing a plan is.
#pragma once

#include <mutex>

namespace albtpu {

inline std::mutex& FftwPlanner() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace albtpu
