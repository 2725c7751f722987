// Frames of the virtual tank one by one: what the light under the waves looks like, and how it goes on.
#pragma once

#include <cstdint>
#include <vector>

#include "validation/laboratory/virtual_tank.h"
#include "validation/report/study.h"

namespace albtpu {

// Where the light of one frame falls at the depth of the array, 2 m/s, nadir.
DataTable LightUnderWaves(std::uint64_t seed);

// What the array at nadir says of one water as it evolves, 20 frames a second as in the laboratory.
struct EvolvingTank {
  double wind_speed;  // m/s
  CentroidScatter array, full_beam;
  double array_correlation, full_beam_correlation;  // of the angle along the wind with that of the next frame
};
std::vector<EvolvingTank> WatchEvolvingTank(const std::vector<double>& winds, int frames, std::uint64_t seed);

DataTable TableOf(const std::vector<EvolvingTank>& tanks);

}  // namespace albtpu
