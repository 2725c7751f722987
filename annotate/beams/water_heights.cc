#include "annotate/beams/water_heights.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "absl/strings/str_cat.h"
#include "sea/samples.h"

namespace albtpu::annotate {
namespace {

constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

constexpr double kFewCrests = 0.01;  // Of all returns near the surface: so few say nothing.
constexpr std::size_t kLeastCrests = 10;
constexpr double kMedianOfHalfNormal = 0.6745;
constexpr double kDeviations = 3.5;  // One trough in 4000 is deeper.

// How far below the surface troughs reach, m, judged by the returns from crests, whose heights are those of a normal
// distribution; 0 where there are none.
double DeepestTrough(std::span<const ReturnPair> pairs, const std::vector<double>& heights) {
  std::vector<double> crests;
  std::size_t below = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i].upper_is_bottom) continue;
    const double above = pairs[i].upper.z() - heights[i];
    if (above > 0 && above <= kHighestCrest) crests.push_back(above);
    below += above <= 0;
  }
  if (crests.size() < kLeastCrests || static_cast<double>(crests.size()) < kFewCrests * static_cast<double>(below))
    return 0;
  return kDeviations / kMedianOfHalfNormal * Median(std::move(crests));
}

constexpr std::size_t kPairsOfPart = 1 << 14;

// Calls function(part, begin, end) for parts of `count` pairs, in parallel.
template <typename Function>
void ForEachPart(std::size_t count, const Function& function) {
  tbb::parallel_for(std::size_t{0}, (count + kPairsOfPart - 1) / kPairsOfPart, [&](std::size_t part) {
    function(part, part * kPairsOfPart, std::min((part + 1) * kPairsOfPart, count));
  });
}

// The height of the water at the upper return of each pair.
std::vector<double> HeightsAtUpper(std::span<const ReturnPair> pairs, const WaterHeights& water,
                                   const formats::LocalFrame& frame) {
  std::vector<double> heights(pairs.size());
  ForEachPart(pairs.size(), [&](std::size_t /*part*/, std::size_t begin, std::size_t end) {
    SurveyPoints upper;
    for (const ReturnPair& pair : pairs.subspan(begin, end - begin)) {
      const formats::MapPosition on_map = frame.MapOf(pair.upper.x(), pair.upper.y());
      upper.x.push_back(on_map.x);
      upper.y.push_back(on_map.y);
      upper.z.push_back(pair.upper.z() / frame.metres_per_z);
      upper.times.push_back(pair.time);
    }
    std::vector<double> of_part;
    SurfaceCounts ignored;
    water.At(upper, frame, of_part, ignored);
    std::ranges::copy(of_part, heights.begin() + static_cast<std::ptrdiff_t>(begin));
  });
  return heights;
}

// Adds a ray. Of rays of one time that follow each other, the longest stays.
void AddLongest(const AirRay& ray, std::vector<AirRay>& rays) {
  if (rays.empty() || rays.back().time != ray.time)
    rays.push_back(ray);
  else if (ray.separation > rays.back().separation)
    rays.back() = ray;
}

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

void WaterHeights::At(const SurveyPoints& points, const formats::LocalFrame& frame, std::vector<double>& heights,
                      SurfaceCounts& counts) const {
  heights.assign(points.size(), level.has_value() ? frame.Z(*level) : kNoHeight);
  if (levels != nullptr) {
    levels->LevelsAt(points.times, heights);
    for (double& height : heights) height = frame.Z(height);
  }
  std::optional<LocalWaterSurface::Reader> nearby;
  if (surface != nullptr) nearby.emplace(*surface);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double own = points.pulse_surface.empty() ? kNoHeight : frame.Z(points.pulse_surface[i]);
    const auto count = [&](SurfaceFrom from) {
      if (!points.is_dry(i)) counts.Add(from);
    };
    if (std::isfinite(own)) {
      heights[i] = own;
      count(SurfaceFrom::kPulse);
      continue;
    }
    std::optional<double> local;
    if (nearby.has_value()) {
      const Eigen::Vector2d at = frame.At(points.x[i], points.y[i]);
      local = nearby->HeightAt(at.x(), at.y(), points.times.empty() ? 0 : seconds * points.times[i]);
    }
    if (local.has_value()) {
      heights[i] = *local;
      count(SurfaceFrom::kLocal);
    } else if (std::isfinite(heights[i])) {
      count(SurfaceFrom::kLevel);
    }
  }
}

std::vector<AirRay> RaysOfPairs(std::span<const ReturnPair> pairs, const WaterHeights& water,
                                const formats::LocalFrame& frame, double index) {
  const std::vector<double> heights = HeightsAtUpper(pairs, water, frame);
  const double trough = DeepestTrough(pairs, heights);
  std::vector<std::vector<AirRay>> parts((pairs.size() + kPairsOfPart - 1) / kPairsOfPart);
  ForEachPart(pairs.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::vector<AirRay> of_part;
    of_part.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      if (!(pairs[i].upper.z() <= heights[i] - (pairs[i].upper_is_bottom ? 0 : trough))) continue;
      if (const std::optional<AirRay> ray = RayOfPair(pairs[i], heights[i], index); ray.has_value())
        AddLongest(*ray, of_part);
    }
    parts[part] = std::move(of_part);
  });
  std::vector<AirRay> rays;
  rays.reserve(pairs.size());
  for (const std::vector<AirRay>& part : parts)
    for (const AirRay& ray : part) AddLongest(ray, rays);
  return rays;
}

}  // namespace albtpu::annotate
