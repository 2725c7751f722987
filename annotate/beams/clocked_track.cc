#include "annotate/beams/clocked_track.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace albtpu::annotate {

ClockedTrack::ClockedTrack(std::unique_ptr<const SensorTrack> track, formats::PointClock clock)
    : track_(std::move(track)), clock_(std::move(clock)) {}

void ClockedTrack::PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                               std::span<TrackOutcome> outcomes) const {
  std::vector<double> read(times.begin(), times.end());
  for (double& time : read) time = formats::IsNoTime(time) ? std::numeric_limits<double>::quiet_NaN() : clock_(time);
  track_->PositionsAt(read, positions, outcomes);
}

ClockedMotions::ClockedMotions(std::unique_ptr<const SensorMotions> motions, formats::PointClock clock)
    : motions_(std::move(motions)), clock_(std::move(clock)) {}

std::optional<SensorMotion> ClockedMotions::At(double time) const {
  if (formats::IsNoTime(time)) return std::nullopt;
  return motions_->At(clock_(time));
}

}  // namespace albtpu::annotate
