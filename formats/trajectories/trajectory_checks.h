// Checks whether a trajectory matches the points of a LAS file, before anything is computed from them.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "formats/crs/map_frame.h"
#include "formats/trajectories/trajectory_timeline.h"

namespace albtpu::formats {

// The bounding box of the points, in their units as the header states it.
struct PointExtent {
  double x_min = 0, x_max = 0, y_min = 0, y_max = 0;
};

// A survey aircraft is nearer to its points than this, even if a file has only a few of them.
inline constexpr double kFarthestFromPoints = 5000;  // m

// InvalidArgument if the trajectory is farther than kFarthestFromPoints from the bounding box at all times of the
// points. The message says how far, and the cause where a change brings the trajectory to the points: another zone, the
// other hemisphere, exchanged latitude and longitude, exchanged x and y, a wrong sign of the longitude or latitude,
// feet for metres. `las` is the file of the points.
absl::Status CheckNearPoints(const std::string& las, const TrajectoryTimeline& timeline, const MapFrame& frame,
                             const PointExtent& extent);

}  // namespace albtpu::formats
