// A track, and the motion along it, at times as the file of the points states them, where these are of another clock
// than the track.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "budget/air/sensor_motion.h"
#include "budget/beams/track_spline.h"
#include "formats/clocks/point_clock.h"

namespace albtpu::annotate {

class ClockedTrack final : public SensorTrack {
 public:
  // `track` has the times that `clock` gives.
  ClockedTrack(std::unique_ptr<const SensorTrack> track, formats::PointClock clock);

  // Points without a time (IsNoTime) are outside of the track.
  void PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                   std::span<TrackOutcome> outcomes) const override;

 private:
  std::unique_ptr<const SensorTrack> track_;
  formats::PointClock clock_;
};

class ClockedMotions final : public SensorMotions {
 public:
  ClockedMotions(std::unique_ptr<const SensorMotions> motions, formats::PointClock clock);

  std::optional<SensorMotion> At(double time) const override;

 private:
  std::unique_ptr<const SensorMotions> motions_;
  formats::PointClock clock_;
};

}  // namespace albtpu::annotate
