// Single frames of the virtual tank: the pattern of light under the waves, its change from frame to frame, and its
// sensitivity to what the paper does not state.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "validation/laboratory/virtual_tank.h"
#include "validation/report/study.h"

namespace albtpu {

// The light of one frame at the depth of the array, 2 m/s, nadir.
DataTable LightUnderWaves(std::uint64_t seed);

// The readings of the array at nadir over one sea as it evolves, at 20 frames per second as in the laboratory.
struct EvolvingTank {
  double wind_speed;  // m/s
  CentroidScatter array, full_beam;
  double array_correlation, full_beam_correlation;  // of the along-wind angle with that of the next frame
};
std::vector<EvolvingTank> WatchEvolvingTank(const std::vector<double>& winds, int frames, std::uint64_t seed);

DataTable TableOf(const std::vector<EvolvingTank>& tanks);

// The sensitivity of the refraction measured by the laboratory's array to what the paper does not state.

struct TankVariation {
  std::string parameter;  // with its unit: "aperture (cm)"
  double value;
  CentroidScatter array, full_beam;
};

// The array of Table 4 at nadir, at 2 m/s and a wave height of 9 mm, with one parameter changed at a time: aperture,
// pitch, number of detectors, profile and wave height (also at 5.25 m/s), and of the simulation itself the number of
// rays, the grid, the patch and the random waves.
std::vector<TankVariation> TankSensitivity(bool quick, int frames, std::uint64_t seed);

DataTable TableOf(const std::vector<TankVariation>& variations);

}  // namespace albtpu
