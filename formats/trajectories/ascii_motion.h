// Checks whether the records of an ASCII trajectory move as an aircraft does. Without stated velocities this detects
// angles in radians, exchanged columns and wrong headings.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "absl/status/status.h"
#include "formats/trajectories/trajectory.h"

namespace albtpu::formats {

// Easting and northing in the map frame that a file was exported in, in the unit of that frame.
struct GridPosition {
  double x = 0, y = 0;
};

// m/s over ground. Below: a slow drone, or degrees that are radians, which divide speeds by 57: from 150 to 2.6 m/s.
inline constexpr double kSlowestFlight = 3;
inline constexpr double kFastestFlight = 150;

// rad, between heading and course over ground in the median: far beyond any crab angle, which wind causes. Only above
// kCrabSpeed [m/s]: slower aircraft may fly sideways.
inline constexpr double kLargestCrab = 0.7853981633974483;  // 45 degrees
inline constexpr double kCrabSpeed = 15;

// InvalidArgument, if possible with the cause, when speeds are not those of an aircraft, when headings do not follow
// the course, when stated velocities disagree with the positions, or when exchanging columns makes X and Y move with
// longitude and latitude. OK where the file is too short or has too many gaps for the check. `grid_position` gives X
// and Y of a record, if the file has them.
absl::Status CheckMotion(const Trajectory& trajectory,
                         const std::function<std::optional<GridPosition>(std::size_t)>& grid_position);

}  // namespace albtpu::formats
