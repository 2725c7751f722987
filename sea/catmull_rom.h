// Interpolation between equidistant values by the cubic of Catmull and Rom (1974), which is exact for a parabola.
#pragma once

#include <array>

namespace albtpu {

// The weights of the values at -1, 0, 1 and 2 for the one at `t`, 0 to 1.
constexpr std::array<double, 4> CatmullRomWeights(double t) {
  return {t * (t * (2 - t) - 1) / 2, (t * t * (3 * t - 5) + 2) / 2, t * (t * (4 - 3 * t) + 1) / 2, t * t * (t - 1) / 2};
}

}  // namespace albtpu
