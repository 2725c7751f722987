// The track of the sensor from trajectories that were read from files, in the coordinates of the points.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "budget/beams/track_spline.h"
#include "formats/crs/map_frame.h"
#include "formats/trajectories/trajectory_timeline.h"

namespace albtpu::annotate {

// From the reference point of the trajectory to the sensor, along the axes of the body: --lever-arm.
struct LeverArm {
  double forward = 0, right = 0, down = 0;  // m

  bool is_zero() const { return forward == 0 && right == 0 && down == 0; }
};

// Components of a vector on the ground, m.
struct NorthEastDown {
  double north = 0, east = 0, down = 0;
};

// The lever arm turned by the attitude, Rz(heading) Ry(pitch) Rx(roll).
NorthEastDown Turned(const LeverArm& arm, double roll, double pitch, double heading);

struct ProjectedTrackOptions {
  LeverArm lever_arm = {};
  double geoid_separation = 0;  // m, N: heights of the points are h - N. --geoid-separation
};

// Positions of the sensor are computed where points ask for them, in blocks of 4096 records of 48 bytes: five hours at
// 200 Hz would be 173 MB if points lay all over them, a line of ten minutes is 6 MB. They are interpolated linearly
// between two records at most 0.2 s apart.
class ProjectedTrack : public SensorTrack {
 public:
  // Fails when there is a lever arm, and a trajectory states no attitude.
  static absl::StatusOr<std::unique_ptr<ProjectedTrack>> Create(formats::TrajectoryTimeline timeline,
                                                                std::shared_ptr<const formats::MapFrame> frame,
                                                                const ProjectedTrackOptions& options);
  ~ProjectedTrack() override;

  void PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                   std::span<TrackOutcome> outcomes) const override;

  const formats::TrajectoryTimeline& timeline() const { return timeline_; }

  // The sensor at a record: lever arm, geoid separation and projection applied. Slow; blocks are filled by it.
  SensorPosition PositionOf(const formats::TrajectoryRecord& record) const;

 private:
  struct Row;
  struct Block;
  class Cursor;

  ProjectedTrack(formats::TrajectoryTimeline timeline, std::shared_ptr<const formats::MapFrame> frame,
                 const ProjectedTrackOptions& options);
  const std::vector<Row>& RowsOf(std::size_t block) const;
  std::vector<Row> Project(const Block& block) const;
  // `x`, or where longitudes repeat that within half a turn of the first record: no step leaps over 180 degrees.
  double Continuous(double x) const;
  formats::GeographicPosition SensorOf(const formats::TrajectoryRecord& record, double& height) const;

  formats::TrajectoryTimeline timeline_;
  std::shared_ptr<const formats::MapFrame> frame_;
  ProjectedTrackOptions options_;
  bool starts_again_ = false;   // Points of the next week have times that started again from 0.
  double first_x_ = 0;          // Of the first record.
  std::vector<double> begins_;  // The time from which each block holds, increasing.
  std::unique_ptr<Block[]> blocks_;
};

}  // namespace albtpu::annotate
