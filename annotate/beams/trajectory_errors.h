// The error files (SMRMSG) of a trajectory: the uncertainty of a trajectory at the points of a file.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/trajectories/smrmsg_file.h"
#include "formats/trajectories/trajectory_timeline.h"

namespace albtpu::annotate {

using TrajectoryErrors = std::vector<std::shared_ptr<const formats::SmrmsgFile>>;

// Opens files and folders. A folder stands for all files in it whose names contain "smrmsg" or "rms", in any case,
// ordered by name. Fails on the first file that is not an SMRMSG, and on a folder without any.
absl::StatusOr<TrajectoryErrors> LoadTrajectoryErrors(std::span<const std::string> paths);

// Medians over the part of the trajectory that has points, one standard deviation.
struct TrajectoryPrecision {
  double horizontal = 0, vertical = 0;  // m; horizontal: the root of the sum of squares of north and east.
};

// nullopt where no error file has records at these times.
std::optional<TrajectoryPrecision> PrecisionOf(const TrajectoryErrors& errors,
                                               const formats::TrajectoryTimeline& timeline);

}  // namespace albtpu::annotate
