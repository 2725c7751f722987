// The degree, for tests that state angles in it.
#pragma once

#include <numbers>

namespace albtpu::testing {

inline constexpr double kDegree = std::numbers::pi / 180;

}  // namespace albtpu::testing
