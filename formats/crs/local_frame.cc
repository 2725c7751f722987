#include "formats/crs/local_frame.h"

#include <cmath>
#include <numbers>

namespace albtpu::formats {
namespace {

constexpr double kSlopeStep = 1000;  // m, over which the slope of the convergence is taken.

}  // namespace

std::optional<LocalFrame> FrameAround(const MapPosition& middle, const MapFrame& map, double metres_per_z) {
  const auto metric_at = [&](double x, double y) -> std::optional<MapMetric> {
    const std::optional<GeographicPosition> position = map.GeographicAt({x, y});
    if (!position.has_value()) return std::nullopt;
    return map.MetricAt(*position);
  };
  const std::optional<MapMetric> metric = metric_at(middle.x, middle.y);
  if (!metric.has_value()) return std::nullopt;
  LocalFrame frame = {.origin_x = middle.x,
                      .origin_y = middle.y,
                      .metres_per_x = metric->metres_per_x,
                      .metres_per_y = metric->metres_per_y,
                      .metres_per_z = metres_per_z,
                      .north_per_x = metric->north_per_x,
                      .turn = map.turn(),
                      .convergence = metric->convergence};
  const auto slope_to = [&](double x, double y) {
    const std::optional<MapMetric> there = metric_at(x, y);
    if (!there.has_value()) return 0.0;
    return std::remainder(there->convergence - metric->convergence, 2 * std::numbers::pi) / kSlopeStep;
  };
  frame.convergence_slope = {slope_to(middle.x + kSlopeStep / frame.metres_per_x, middle.y),
                             slope_to(middle.x, middle.y + kSlopeStep / frame.metres_per_y)};
  return frame;
}

}  // namespace albtpu::formats
