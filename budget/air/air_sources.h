// The errors of the air side of one pulse, source by source, in double precision: the slow and obvious twin of
// air_covariance-inl.h, and what explains a pulse to a person. At the end the constants of that twin.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "budget/air/air_errors.h"
#include "sea/water_index.h"

namespace albtpu {

// Where a beam went, over level and still water. Angles in degrees, lengths in m, times in s. Axes: north, east, down;
// those of the aircraft: forward, right, down, turned by heading, pitch and roll, R = Rz(heading) Ry(pitch) Rx(roll).
struct AirPulse {
  double incidence = 0;     // From the vertical, in air: 0 or more, below 90.
  double beam_azimuth = 0;  // Where the beam travels to, clockwise from true north.
  double altitude = 0;      // Of the sensor above the water: above 0.
  double depth = 0;         // Of the point below the water: 0 or more.
  double roll = 0, pitch = 0, heading = 0;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();   // m/s; north, east, down.
  Eigen::Vector3d rates = Eigen::Vector3d::Zero();      // degree/s; about the axes of the aircraft.
  Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();  // m; from the trajectory's point to the sensor, aircraft axes.
  double index = kSeaWaterIndex;                        // Refractive index of the water: 1 or more.
};

// What a source contributes: the error of the reported point is `columns` times independent standard normal numbers.
struct AirSource {
  std::string_view name;  // "position", "attitude", ...: the names of AirErrors.
  ErrorGroup group;
  Eigen::Matrix3Xd columns;  // m; north, east, down.

  Eigen::Matrix3d Covariance() const { return columns * columns.transpose(); }
};

// All sources, in the order of AirErrors, to first order in the errors.
//
// With O the point of the trajectory, l the lever arm, u the direction of the beam in air, rho the slant range, T the
// measured optical range and w the direction in water, which Snell's law makes of u, the point is
//     B = O + R l + rho u + s w,    s = (T - rho) / n.
// Where the surface was located by the lidar, rho is measured; where a level gives its height, rho follows from O and
// u. docs/budget.md has the derivatives.
//
// A model of the surface that is made of many returns moves with all that these have in common, as the pulse's own
// return does, but not with the scan angle of this pulse: for that its height is given.
//
// Example, a nadir beam from 400 m over 10 m of water:
//     AirSources({.altitude = 400, .depth = 10}, SurfaceLocation::kPulse, {.position = {0.02, 0.02, 0.06}});
std::vector<AirSource> AirSources(const AirPulse& pulse, SurfaceLocation located, const AirErrors& errors);

// The error of the point for each metre by which the surface at this pulse lies above where it was located, which
// is what a wave does that the location does not see: north, east, down.
Eigen::Vector3d ErrorOfSurfaceHeight(const AirPulse& pulse);

// What all pulses of a batch have in common on the air side.

// AirErrors in single precision, with angles in radians, and constants made of them.
struct AirConstants {
  // `lever_arm`: m; forward, right, down.
  AirConstants(const AirErrors& errors, SurfaceLocation located, double index, const std::array<double, 3>& lever_arm);

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
