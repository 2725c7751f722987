// Where processing puts the returns of a pulse, with the errors of its inputs.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tests/flights/beam_path.h"

namespace albtpu::testing {

// Standard deviations of the trajectory that its files state: m north, east and up; rad of roll, pitch and heading.
inline constexpr double kPositionSigma = 0.02, kHeightSigma = 0.04;
inline constexpr double kRollSigma = 0.0025 * std::numbers::pi / 180, kHeadingSigma = 2 * kRollSigma;

// With any of these, points are delivered where processing would put them, which knows the trajectory and the scan with
// their errors, takes the water as level where the pulse met it, and divides optical ranges by the index.
struct ReportingErrors {
  bool trajectory = false;                   // As large as its files state.
  double scan = 0;                           // rad, one sigma of each of two angles.
  double slope_along = 0, slope_across = 0;  // One sigma of slopes of the water, along and across the wind.
  double wind_from = 0;                      // rad, clockwise from true north

  bool any() const { return trajectory || scan > 0 || slope_along > 0 || slope_across > 0; }
};

// Errors of the trajectory are smooth functions of the time of a line, over tens of seconds; those of the scan, of
// ranges and of the slope of the water are drawn anew for each pulse.
class ReportedPoints {
 public:
  // `lever_arm` in the body, m; `range_noise`: one sigma of the optical ranges to the surface and to the bottom, m.
  ReportedPoints(const ReportingErrors& errors, const Eigen::Vector3d& lever_arm, double range_noise, int lines,
                 std::uint64_t seed);

  // The direction of the beam in the water at a slope that is drawn: that of the next pulse that is received.
  Eigen::Vector3d Refracted(const BeamPath& path, const Eigen::Vector3d& beam);

  // A pulse in the direction `in_body` (body axes), which met the water as `path` tells.
  void Receive(int line, double since_start, const AircraftState& aircraft, const Eigen::Vector3d& in_body,
               const BeamPath& path);

  // A return of that pulse from `way` m behind the water, 0: from the surface. Earth-centred, m.
  Eigen::Vector3d Reported(double way);

  // A return of that pulse from dry land, `range` m from the sensor: the beam goes straight.
  Eigen::Vector3d ReportedOnLand(double range) const;

 private:
  ReportingErrors errors_;
  Eigen::Vector3d lever_arm_;
  double range_noise_;
  RandomNumbers random_;
  std::vector<std::array<SmoothMotion, 6>> of_lines_;      // North, east, down; roll, pitch, heading.
  Eigen::Vector3d sensor_, in_air_, at_water_, in_water_;  // Of the pulse that was received.
  double surface_noise_ = 0;                               // m, of its range to the surface.
};

}  // namespace albtpu::testing
