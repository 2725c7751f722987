// The motion of the aircraft, from the files of its trajectory or from a track fitted to the returns.
#pragma once

#include <optional>

#include "annotate/beams/trajectory_errors.h"
#include "budget/air/sensor_motion.h"
#include "budget/beams/sensor_track.h"
#include "formats/trajectories/trajectory_timeline.h"

namespace albtpu::annotate {

// Attitude, velocity and rates as the trajectory states them. Where it states no heading, the course; no velocity: that
// of its positions. Standard deviations are those of the error files, or those of the trajectory file itself.
class TrajectoryMotions final : public SensorMotions {
 public:
  TrajectoryMotions(formats::TrajectoryTimeline timeline, TrajectoryErrors errors)
      : timeline_(std::move(timeline)), errors_(std::move(errors)) {}

  std::optional<SensorMotion> At(double time) const override;

 private:
  std::optional<formats::TrajectorySigma> SigmaAt(double time) const;

  formats::TrajectoryTimeline timeline_;
  TrajectoryErrors errors_;
};

// Velocity and course of any track of the sensor; no attitude.
class CourseMotions final : public SensorMotions {
 public:
  // `track` must outlive it.
  explicit CourseMotions(const SensorTrack& track) : track_(track) {}

  std::optional<SensorMotion> At(double time) const override;

 private:
  const SensorTrack& track_;
};

}  // namespace albtpu::annotate
