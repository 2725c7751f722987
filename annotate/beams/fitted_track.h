// The track that was fitted to the returns of a file, in the coordinates of its points.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "annotate/beams/local_frame.h"
#include "budget/beams/ray_track.h"
#include "budget/beams/sensor_track.h"
#include "formats/crs/map_frame.h"

namespace albtpu::annotate {

class FittedTrack final : public SensorTrack {
 public:
  // `track` is in `frame`. Without `map`, grid north is taken for true north.
  FittedTrack(RayTrack track, const LocalFrame& frame, const formats::MapFrame* map);

  void PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                   std::span<TrackOutcome> outcomes) const override;

  const RayTrack& track() const { return track_; }

 private:
  RayTrack track_;
  LocalFrame frame_;
  // The convergence is taken as linear in the local coordinates. It is about (longitude - central meridian) times
  // sin(latitude), so that 15 km from the middle, a file leaves 1e-5 rad of it out.
  double convergence_ = 0;
  Eigen::Vector2d convergence_slope_ = Eigen::Vector2d::Zero();  // rad/m
};

}  // namespace albtpu::annotate
