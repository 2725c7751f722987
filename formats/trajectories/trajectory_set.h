// The trajectories of a survey: one file or many.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/trajectories/trajectory.h"

namespace albtpu::formats {

using TrajectoryFiles = std::vector<std::shared_ptr<const Trajectory>>;

// Opens files and folders. A folder stands for all files in it whose extension is .sbet, .sbt, .out, .trj, .txt or
// .csv, in any case, ordered by name; subfolders are not searched. Error files (SMRMSG) and reports lie beside SBETs
// under the same extensions: in a folder, a file whose name contains "smrmsg", "rms" or "report" is left out. Fails on
// the first file that is not a trajectory, and on a folder without any.
absl::StatusOr<TrajectoryFiles> LoadTrajectories(std::span<const std::string> paths);

}  // namespace albtpu::formats
