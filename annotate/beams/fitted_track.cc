#include "annotate/beams/fitted_track.h"

#include <optional>
#include <utility>

namespace albtpu::annotate {
namespace {

constexpr double kStep = 1000;  // m, over which the slope of the convergence is taken.

}  // namespace

FittedTrack::FittedTrack(RayTrack track, const LocalFrame& frame, const formats::MapFrame* map)
    : track_(std::move(track)), frame_(frame) {
  if (map == nullptr) return;
  const auto convergence_at = [&](double east, double north) -> std::optional<double> {
    const std::optional<formats::GeographicPosition> position = map->GeographicAt(
        {frame.origin_x + east / frame.metres_per_x, frame.origin_y + north / frame.metres_per_y});
    if (!position.has_value()) return std::nullopt;
    return map->MetricAt(*position).convergence;
  };
  const std::optional<double> middle = convergence_at(0, 0);
  const std::optional<double> east = convergence_at(kStep, 0), north = convergence_at(0, kStep);
  if (!middle.has_value() || !east.has_value() || !north.has_value()) return;
  convergence_ = *middle;
  convergence_slope_ = {(*east - *middle) / kStep, (*north - *middle) / kStep};
}

void FittedTrack::PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                              std::span<TrackOutcome> outcomes) const {
  track_.PositionsAt(times, positions, outcomes);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (outcomes[i] != TrackOutcome::kKnown) continue;
    SensorPosition& position = positions[i];
    position.convergence = convergence_ + convergence_slope_.dot(Eigen::Vector2d(position.x, position.y));
    position.x = frame_.origin_x + position.x / frame_.metres_per_x;
    position.y = frame_.origin_y + position.y / frame_.metres_per_y;
    position.metres_per_x = frame_.metres_per_x;
    position.metres_per_y = frame_.metres_per_y;
  }
}

}  // namespace albtpu::annotate
