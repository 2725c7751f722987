// Long runs of tests that otherwise take some of their cases: ALBTPU_EVERY_CASE=1.
#pragma once

#include <cstdlib>

namespace albtpu::testing {

inline bool EveryCase() { return std::getenv("ALBTPU_EVERY_CASE") != nullptr; }

}  // namespace albtpu::testing
