#include "annotate/beams/pair_rays.h"

#include <cmath>
#include <optional>

namespace albtpu::annotate {

std::vector<AirRay> RaysOfPairs(std::span<const ReturnPair> pairs, const WaterHeights& water,
                                const LocalFrame& frame, double index) {
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
    if (rays.empty() || rays.back().time != ray->time) {
      rays.push_back(*ray);
    } else if (ray->separation > rays.back().separation) {
      rays.back() = *ray;
    }
  }
  return rays;
}

}  // namespace albtpu::annotate
