// How well the trajectories of a survey are known: their error files (SMRMSG) by time.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/clocks/span_index.h"
#include "formats/trajectories/sbet_file.h"
#include "formats/trajectories/trajectory_timeline.h"

namespace albtpu::formats {

// The error files of one run of a timeline.
struct ErrorsOfRun {
  std::vector<std::shared_ptr<const SmrmsgFile>> files;
  std::vector<std::string> left_out;  // Names of files of other flights at the same seconds of a week.

  // By the first file that has a record there; in the times of the trajectory.
  std::optional<TrajectorySigma> SigmaAt(double time) const;
};

class TrajectoryErrors {
 public:
  using Files = std::vector<std::shared_ptr<const SmrmsgFile>>;

  // An SMRMSG covers the same time as the trajectory that it was made with, but for this.
  static constexpr double kSameFlight = 5;  // s

  TrajectoryErrors() = default;
  // `skipped` are files that were left out, a line for the user each, with the reason.
  explicit TrajectoryErrors(Files files, std::vector<std::string> skipped = {});

  bool empty() const { return files_.empty(); }
  std::size_t size() const { return files_.size(); }
  const std::shared_ptr<const SmrmsgFile>& operator[](std::size_t file) const { return files_[file]; }
  Files::const_iterator begin() const { return files_.begin(); }
  Files::const_iterator end() const { return files_.end(); }
  const std::vector<std::string>& skipped() const { return skipped_; }

  // The files for each run of a timeline. An SMRMSG does not name its week. Where two files contradict each other at
  // the times of the points, the one counts that begins and ends with the trajectory of the run. FailedPrecondition
  // where no file does, or where several do and contradict each other.
  absl::StatusOr<std::vector<ErrorsOfRun>> Of(const TrajectoryTimeline& timeline) const;

 private:
  absl::StatusOr<ErrorsOfRun> Of(const TimelineRun& run, const TimeSpan& points) const;

  Files files_;
  std::vector<std::string> skipped_;
  SpanIndex spans_;
};

// Opens files and folders. Of a folder, the files that are an SMRMSG by their contents are opened, in the order of
// their names. skipped() lists those that are trajectories although their names say otherwise (smrmsg, rms). Fails on
// the first of the others that is not a sound SMRMSG although its name says so, and on a folder without any.
absl::StatusOr<TrajectoryErrors> LoadTrajectoryErrors(std::span<const std::string> paths);

}  // namespace albtpu::formats
