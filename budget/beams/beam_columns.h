// The beams of many pulses: from where each point lies, seen from the sensor, to incidence, azimuth, slant range and
// path in water.
#pragma once

#include <numbers>
#include <span>

namespace albtpu {

// The places of points relative to the sensor: one element for each pulse in each column.
struct PointColumns {
  std::span<const double> east;    // m, point minus sensor, true horizontal metres along the axes of the grid.
  std::span<const double> north;   // m, the same.
  std::span<const double> height;  // m, of the sensor above the water at this pulse; above 0.
  std::span<const double> depth;   // m, of the point below the water; 0 or less: not under water.
  // rad, in [-pi, pi]: true azimuth = grid azimuth + convergence. One element for each pulse, or one for all, or none,
  // which is 0.
  std::span<const double> convergence = {};
};

// The beams to these points. The columns have the length of those of the points; an empty one is not written.
//
// The water is still and level. A point under water is reached by the refracted path (refracted_path.h). A point above
// it is reached in a straight line: then the incidence is the angle of that line from the vertical, the slant range is
// the distance from the sensor to the point, and the path in water is 0. Where the sensor is not above the water, or a
// number is NaN that they depend on, incidence and slant range are NaN.
struct BeamColumns {
  std::span<double> incidence = {};    // rad, in air, from the vertical, where the beam meets the water.
  std::span<double> azimuth = {};      // rad, in [0, 2 pi): where the beam travels to, clockwise from true north.
  std::span<double> slant_range = {};  // m, in air: from the sensor to the water.
  std::span<double> water_path = {};   // m, in water: from the surface to the point.
};

// Computes `beams` for all `points`; `index` is that of the water, at least 1 (kSeaWaterIndex of
// refracted_path.h). Allocates nothing. Each beam depends on its point alone.
//
// Only +, -, *, /, square roots and comparisons in one fixed order are used, never a fused multiply-add: a program in
// another language that follows this order has the same bits, on every processor. albtpu.geometry does, in Python.
// Errors, for the ranges of refracted_path.h: incidence and azimuth 1e-10 rad at heights above 30 m, lengths 1e-9 m.
void ComputeBeams(const PointColumns& points, double index, const BeamColumns& beams);

// The diameter [m], across its axis, of a beam after `slant_range` [m]. `divergence` is the full angle [rad] and
// `aperture` the diameter where the beam leaves the sensor [m], both to the same edge, such as 1/e^2.
constexpr double FootprintDiameter(double slant_range, double divergence, double aperture = 0) {
  return slant_range * divergence + aperture;
}

// The azimuth of a beam from downwind, in [0, 2 pi) rad. `azimuth` is where the beam travels to, in [0, 2 pi), and
// `wind_from` where the wind comes from, in [0, 2 pi]; both clockwise from true north.
constexpr double AzimuthFromDownwind(double azimuth, double wind_from) {
  constexpr double kHalfTurn = std::numbers::pi, kFullTurn = 2 * std::numbers::pi;
  const double from_downwind = azimuth - (wind_from + kHalfTurn);  // In [-3 pi, pi).
  const double once = from_downwind < 0 ? from_downwind + kFullTurn : from_downwind;
  const double twice = once < 0 ? once + kFullTurn : once;
  return twice >= kFullTurn ? twice - kFullTurn : twice;  // A tiny negative number plus 2 pi is 2 pi.
}

}  // namespace albtpu
