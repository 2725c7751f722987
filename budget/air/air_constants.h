// What all pulses of a batch have in common on the air side.
#pragma once

#include <array>

#include "budget/air/air_errors.h"

namespace albtpu {

// AirErrors in single precision, with angles in radians, and constants made of them.
struct AirConstants {
  // `lever_arm`: m; forward, right, down.
  AirConstants(const AirErrors& errors, SurfaceLocation located, double index,
               const std::array<double, 3>& lever_arm);

  // A standard deviation. That of the range to the surface is 0 unless the pulse's own return located it.
  template <auto source>
  float Sigma(std::size_t i = 0) const {
    constexpr std::size_t kFirst = FirstNumber(source);
    return sigmas[kFirst + i];
  }

  float inverse_index, inverse_square_index;
  // 1 where the height of the surface is given, 0 where the lidar located it: for all errors, and for the scan angle.
  float given, scan_given;
  float forward, right, down;          // The lever arm, m.
  float surface_height[kErrorGroups];  // In its group, else 0.

 private:
  std::array<float, kErrorNumberCount> sigmas;  // In the order of kErrorSources.
};

}  // namespace albtpu
