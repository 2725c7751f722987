// Neighbouring points of two lines, and how much their heights differ beyond the slope of the bottom.
#pragma once

#include <cstdint>
#include <vector>

#include "quality/crosscheck/overlap_patches.h"

namespace albtpu::quality {

struct CrossPair {
  std::uint16_t line_a = 0, line_b = 0;      // a < b
  double x = 0, y = 0;                       // m, of the patch.
  float difference = 0;                      // m, height in line a less that in line b, without the slope.
  float distance = 0;                        // m, horizontal.
  float variance_air = 0, variance_sea = 0;  // m^2, sums over both points, of the height above the slope.
  float variance_slope = 0;                  // m^2, of the error of the slope over the distance.
  float depth = 0, incidence = 0;            // Means of both; m, degree.

  float variance() const { return variance_air + variance_sea + variance_slope; }
};

// Of each two lines that have at least `kMinPoints` points each in `patch`, the two nearest points. The slope is that
// of planes fitted to all points of the patch, one for each line, which are parallel: a constant height error of a line
// does not tilt it. None where the points do not define a slope.
inline constexpr std::size_t kMinPoints = 3;
void AppendPairs(Patch& patch, std::vector<CrossPair>& pairs);

}  // namespace albtpu::quality
