// Opens a trajectory of any format.
#pragma once

#include <filesystem>
#include <memory>

#include "absl/status/statusor.h"
#include "formats/trajectories/trajectory.h"

namespace albtpu::formats {

// The format is detected by the content: text is an ASCII trajectory, everything else an SBET.
absl::StatusOr<std::unique_ptr<Trajectory>> OpenTrajectory(const std::filesystem::path& path);

}  // namespace albtpu::formats
