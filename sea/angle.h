// Conversion between degrees, used at the edges (tables, campaigns, flags), and radians, used everywhere else.
#pragma once

#include <numbers>

namespace albtpu {

constexpr double RadiansOfDegrees(double degrees) { return degrees * std::numbers::pi / 180; }
constexpr double DegreesOfRadians(double radians) { return radians * 180 / std::numbers::pi; }

}  // namespace albtpu
