// The trajectories of a survey in the order of their times, as the points of one LAS file count them.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/clocks/trajectory_time.h"
#include "formats/trajectories/trajectory.h"
#include "formats/trajectories/trajectory_files.h"

namespace albtpu::formats {

// Two or more records of one file without a gap between them, in the times of the points.
struct TimelineRun {
  std::shared_ptr<const Trajectory> trajectory;
  double offset = 0;               // s; time of a point = time of the trajectory + offset.
  std::size_t begin = 0, end = 0;  // Records.

  double TimeAt(std::size_t record) const { return trajectory->TimeAt(record) + offset; }
  TimeSpan span() const { return {TimeAt(begin), TimeAt(end - 1)}; }
};

// Two files may overlap, as those of a mission that was processed in parts do. Where they state positions that differ
// by more than this, they contradict each other. Solutions of one flight differ by centimetres.
inline constexpr double kLargestContradiction = 0.3;  // m

// `first` to `second`, at most kLongestStep apart: position and velocity linear in time, angles the short way round.
// The error of the position is a t^2 / 8: 2.5 cm in a turn of 5 m/s^2 at 5 Hz, 0.02 mm at 200 Hz.
TrajectoryRecord Interpolate(const TrajectoryRecord& first, const TrajectoryRecord& second, double time);

class TrajectoryTimeline {
 public:
  // Keeps the records that overlap the points in time. Fails when no file does (TimeOffset), when no two of their
  // records are near enough to be interpolated, and when two files contradict each other.
  static absl::StatusOr<TrajectoryTimeline> Create(const TrajectoryFiles& files, TrajectoryClock clock,
                                                   const PointTimes& points);

  // Not empty, in the order of their times. A run ends after the one before it, and overlaps it by one step at most.
  const std::vector<TimelineRun>& runs() const { return runs_; }
  const PointTimes& points() const { return points_; }

  // Position, velocity and attitude at the time of a point; nullopt before the first record, after the last one, and in
  // a gap longer than kLongestStep. Seconds of the week that start again from 0 belong to the next week. The simple and
  // slow twin of ProjectedTrack.
  std::optional<TrajectoryRecord> RecordAt(double time) const;

 private:
  explicit TrajectoryTimeline(const PointTimes& points) : points_(points) {}

  PointTimes points_;
  std::vector<TimelineRun> runs_;
};

}  // namespace albtpu::formats
