// The sensitivity of the refraction measured by the laboratory's array to what the paper does not state.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "validation/laboratory/virtual_tank.h"
#include "validation/report/study.h"

namespace albtpu {

struct TankVariation {
  std::string parameter;  // with its unit: "aperture (cm)"
  double value;
  CentroidScatter array, full_beam;
};

// The array of Table 4 at nadir, at 2 m/s and a wave height of 9 mm, with one parameter changed at a time: aperture,
// pitch, number of detectors, profile and wave height (also at 5.25 m/s), and of the simulation itself the number of
// rays, the grid, the patch and the random waves.
std::vector<TankVariation> TankSensitivity(bool quick, std::uint64_t seed);

DataTable TableOf(const std::vector<TankVariation>& variations);

}  // namespace albtpu
