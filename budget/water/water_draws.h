// Random waters that are consistent with what is known.
#pragma once

#include <cstddef>
#include <vector>

#include "budget/water/water_optics.h"

namespace albtpu {

struct DrawnWater {
  double attenuation, ratio, fraction;  // 1/m; scattering over absorption; backscatter fraction
};

// `count` waters, even over the three distributions of `optics` by Halton's points: the same for the same optics. None
// absorbs less than pure water.
std::vector<DrawnWater> DrawWaters(const WaterOptics& optics, std::size_t count);

// The share of the waters of `optics`, 0 to 1, that scatter more than `ratio` times as much as they absorb. That none
// absorbs less than pure water does not count here.
double ShareBeyond(const WaterOptics& optics, double ratio);

}  // namespace albtpu
