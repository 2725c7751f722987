// How the refraction that the laboratory's array measures depends on what the paper does not tell.
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

// The array of Table 4 at nadir in 2 m/s and waves of 9 mm with one thing changed at a time: aperture,
// pitch, number of detectors, profile, wave height (also at 5.25 m/s), and what is ours: rays, grid, patch,
// other random waves.
std::vector<TankVariation> TankSensitivity(bool quick, std::uint64_t seed);

DataTable TableOf(const std::vector<TankVariation>& variations);

}  // namespace albtpu
