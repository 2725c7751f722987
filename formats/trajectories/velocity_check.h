// Compares the velocities of a trajectory with the differences of its positions. They agree within some cm/s in a
// correct file, but not with angles in degrees, exchanged fields, a wander angle that was not applied, feet or
// unordered records.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "formats/trajectories/trajectory.h"

namespace albtpu::formats {

// m/s, the limit of the root mean square difference: 0.04 m/s were found in a real SBET, and 1.4-80 m/s with any other
// sign or order of its velocities.
inline constexpr double kLargestVelocityDifference = 1;

// s; two records further apart than this have a gap between them. The little more is for rates of 5 Hz whose times were
// rounded.
inline constexpr double kLongestStep = 0.2 + 1e-6;

// The two ends of a short stretch without a gap.
struct RecordPair {
  std::size_t first = 0, second = 0;
};

// At most 4096 stretches that are spread evenly over the file, each at least 0.1 s long where the rate allows it: noise
// of 1 mm of the positions is 0.014 m/s then, and the velocity changes little between the ends.
std::vector<RecordPair> SpreadPairs(const Trajectory& trajectory);

// Velocity in m/s, from the differences of position and as the mean of the velocities that the two records state.
struct VelocityPair {
  double north = 0, east = 0, up = 0;
  double stated_north = 0, stated_east = 0, stated_up = 0;
};
VelocityPair CompareVelocities(const TrajectoryRecord& first, const TrajectoryRecord& second);

// Root mean square of the length of the difference vector, m/s. The largest hundredth of the differences is left out:
// a jump where two solutions were joined does not make a file wrong.
double VelocityDifference(std::span<const VelocityPair> pairs);

// The same for a trajectory; nullopt if it states no velocities, or has no stretch without a gap.
std::optional<double> VelocityDifference(const Trajectory& trajectory);

}  // namespace albtpu::formats
