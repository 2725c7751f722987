// The trajectories of a survey: opened by their content, and collected from files and folders.
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/clocks/span_index.h"
#include "formats/clocks/trajectory_time.h"
#include "formats/trajectories/sbet_record.h"
#include "formats/trajectories/trajectory.h"

namespace albtpu::formats {

// The format is detected by the content: text is an ASCII trajectory, everything else an SBET, whose velocities are
// along `axes`.
absl::StatusOr<std::unique_ptr<Trajectory>> OpenTrajectory(const std::filesystem::path& path,
                                                           VelocityAxes axes = VelocityAxes::kAuto);

// The trajectories of a survey: one file or many. Immutable.
class TrajectoryFiles {
 public:
  using Files = std::vector<std::shared_ptr<const Trajectory>>;

  TrajectoryFiles() = default;
  // `skipped` are files that were left out, a line for the user each, with the reason.
  explicit TrajectoryFiles(Files files, std::vector<std::string> skipped = {});
  TrajectoryFiles(std::initializer_list<std::shared_ptr<const Trajectory>> files) : TrajectoryFiles(Files(files)) {}

  bool empty() const { return files_.empty(); }
  std::size_t size() const { return files_.size(); }
  const std::shared_ptr<const Trajectory>& front() const { return files_.front(); }
  const std::shared_ptr<const Trajectory>& operator[](std::size_t file) const { return files_[file]; }
  Files::const_iterator begin() const { return files_.begin(); }
  Files::const_iterator end() const { return files_.end(); }
  const std::vector<std::string>& skipped() const { return skipped_; }

  // The files that may have records at the times of the points, in their order: all that have, by any clock and in any
  // week that TimeOffset considers, and few others. The time that it takes does not grow with the number of files, but
  // for a logarithm.
  std::vector<std::size_t> NearTimesOf(const PointTimes& points) const;

 private:
  Files files_;
  std::vector<std::string> skipped_;
  SpanIndex spans_;
};

// Opens files and folders. Of a folder, the files with the extension .sbet, .sbt, .out, .trj, .txt or .csv, in any
// case, are opened in the order of their names; subfolders are not searched. Contents decide: error files (SMRMSG) and
// text that is no trajectory are skipped, and so is a file that cannot be read and whose name says that it is an error
// file or a report (smrmsg, rms, report). skipped() lists them, and files of other extensions. Fails on the first other
// file that is not a trajectory, and on a folder without any.
absl::StatusOr<TrajectoryFiles> LoadTrajectories(std::span<const std::string> paths,
                                                 VelocityAxes axes = VelocityAxes::kAuto);

}  // namespace albtpu::formats
