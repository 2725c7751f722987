// The depth of water in which waves do not reach the bottom.
#pragma once

#include <limits>

namespace albtpu {

inline constexpr double kDeep = std::numeric_limits<double>::infinity();  // m

}  // namespace albtpu
