#include "annotate/beams/water_heights.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"

namespace albtpu::annotate {
namespace {

constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void SurfaceCounts::Merge(const SurfaceCounts& other) {
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
}

nlohmann::ordered_json SurfaceCounts::Json() const {
  return {{"pulse", (*this)[SurfaceFrom::kPulse]},
          {"local", (*this)[SurfaceFrom::kLocal]},
          {"level", (*this)[SurfaceFrom::kLevel]}};
}

std::string SurfaceCounts::Text() const {
  return absl::StrCat("from a return of the same pulse at ", (*this)[SurfaceFrom::kPulse],
                      " points, from returns nearby at ", (*this)[SurfaceFrom::kLocal], ", from the level at ",
                      (*this)[SurfaceFrom::kLevel]);
}

void WaterHeights::At(const SurveyPoints& points, const LocalFrame& frame, std::vector<double>& heights,
                      SurfaceCounts& counts) const {
  heights.assign(points.size(), level.has_value() ? frame.Z(*level) : kNoHeight);
  if (levels != nullptr) {
    levels->LevelsAt(points.times, heights);
    for (double& height : heights) height = frame.Z(height);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double own = points.pulse_surface.empty() ? kNoHeight : frame.Z(points.pulse_surface[i]);
    if (std::isfinite(own)) {
      heights[i] = own;
      counts.Add(SurfaceFrom::kPulse);
      continue;
    }
    const std::optional<double> local =
        surface == nullptr
            ? std::nullopt
            : surface->HeightAt(frame.X(points.x[i]), frame.Y(points.y[i]), points.times.empty() ? 0 : points.times[i]);
    if (local.has_value()) {
      heights[i] = *local;
      counts.Add(SurfaceFrom::kLocal);
    } else if (std::isfinite(heights[i])) {
      counts.Add(SurfaceFrom::kLevel);
    }
  }
}

std::vector<AirRay> RaysOfPairs(std::span<const ReturnPair> pairs, const WaterHeights& water, const LocalFrame& frame,
                                double index) {
  SurveyPoints upper;
  for (const ReturnPair& pair : pairs) {
    upper.x.push_back(frame.origin_x + pair.upper.x() / frame.metres_per_x);
    upper.y.push_back(frame.origin_y + pair.upper.y() / frame.metres_per_y);
    upper.z.push_back(pair.upper.z() / frame.metres_per_z);
    upper.times.push_back(pair.time);
  }
  std::vector<double> heights;
  SurfaceCounts ignored;
  water.At(upper, frame, heights, ignored);
  std::vector<AirRay> rays;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!std::isfinite(heights[i])) continue;
    const std::optional<AirRay> ray = RayOfPair(pairs[i], heights[i], index);
    if (!ray.has_value()) continue;
    if (rays.empty() || rays.back().time != ray->time)
      rays.push_back(*ray);
    else if (ray->separation > rays.back().separation)
      rays.back() = *ray;
  }
  return rays;
}

}  // namespace albtpu::annotate
