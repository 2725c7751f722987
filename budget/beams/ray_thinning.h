// Thins the rays of a long recording: keeps the most informative ones, at most a given number.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "budget/beams/return_pair.h"

namespace albtpu {

struct RayThinning {
  double bin = 0.005;              // s; shorter than a revolution of a scanner, so that all azimuths stay.
  std::size_t rays_per_bin = 20;   // At most 4000 rays a second.
  std::size_t max_rays = 2000000;  // Of all bins together; beyond it, `rays_per_bin` falls, down to 1.
};

// The rays in order of time, those that are not finite left out, at most `rays_per_bin` in each `bin` of time. The ones
// of long separation stay, by classes a factor of sqrt(2) wide; within a class a hash of the time decides. Choosing
// the very longest would favour errors that lengthen a pair, and so bias its direction where all are about equal.
std::vector<AirRay> ThinRays(std::span<const AirRay> rays, const RayThinning& thinning);

}  // namespace albtpu
