// Whether a trajectory moves as an aircraft does: the records of an ASCII trajectory by their speeds and headings, and
// any trajectory by its stated velocities.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "formats/trajectories/trajectory.h"

namespace albtpu::formats {

// Checks whether the records of an ASCII trajectory move as an aircraft does. Without stated velocities this detects
// angles in radians, exchanged columns and wrong headings.

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

// Compares the velocities of a trajectory with the differences of its positions. They agree within some cm/s in a
// correct file, but not with angles in degrees, exchanged fields, a wander angle that was not applied, feet or
// unordered records.

// m/s, the limit of the root mean square difference: 0.04 m/s were found in a real SBET, and 1.4-80 m/s with any other
// sign or order of its velocities.
inline constexpr double kLargestVelocityDifference = 1;

// s; two records further apart than this have a gap between them. The little more is for rates of 5 Hz whose times were
// rounded.
inline constexpr double kLongestStep = 0.2 + 1e-6;

// InvalidArgument if a record is more than 20 m from the one before it and was reached faster than 400 m/s: points
// would lie between a right position and a wrong one. Names the record and its time. Looks at all records, of which
// `place_at` gives time and position alone.
absl::Status CheckJumps(const Trajectory& trajectory, const std::function<TrajectoryRecord(std::size_t)>& place_at);

// The two ends of a short stretch without a gap.
struct RecordPair {
  std::size_t first = 0, second = 0;
};

// At most 4096 stretches that are spread evenly over the file, each at least 0.1 s long where the rate allows it: noise
// of 1 mm of the positions is 0.014 m/s then, and the velocity changes little between the ends.
// Stretches with a step above `longest_step` [s] are left out.
std::vector<RecordPair> SpreadPairs(const Trajectory& trajectory, double longest_step = kLongestStep);

// Velocity in m/s, from the differences of position and as the mean of the velocities that the two records state.
struct VelocityPair {
  double north = 0, east = 0, up = 0;
  double stated_north = 0, stated_east = 0, stated_up = 0;
};
VelocityPair CompareVelocities(const TrajectoryRecord& first, const TrajectoryRecord& second);

// Root mean square of the length of the difference vector, m/s. The largest hundredth of the differences is left out:
// a jump where two solutions were joined does not make a file wrong.
double VelocityDifference(std::span<const VelocityPair> pairs);

// The same for a trajectory; nullopt if it states no velocities of its own, or has no stretch without a gap.
std::optional<double> VelocityDifference(const Trajectory& trajectory);

}  // namespace albtpu::formats
