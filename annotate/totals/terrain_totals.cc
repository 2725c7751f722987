#include "annotate/totals/terrain_totals.h"

#include <array>
#include <cmath>
#include <numbers>

namespace albtpu::annotate {
namespace {

constexpr std::size_t kDown = 2;  // Of the entries of a covariance.

std::array<double, 6> Entries(const TotalBatch::Covariance& covariance, std::size_t i) {
  std::array<double, 6> entries;
  for (std::size_t k = 0; k < entries.size(); ++k) entries[k] = covariance[k][i];
  return entries;
}

}  // namespace

TerrainShare AddTerrain(Coverage coverage, const SlopingPoint& point, std::size_t i, TotalBatch& totals) {
  const TerrainGradient& gradient = point.gradient;
  const double factor = VerticalFactor(coverage);
  const double of_footprint = FootprintVariance(point.footprint, point.incidence, point.azimuth, gradient);
  const std::array<double, 6> total = Entries(totals.covariance, i);
  if (!std::isfinite(of_footprint) || !std::isfinite(total[kDown])) return {};
  const auto at_coverage = [&](double variance) { return static_cast<float>(factor * std::sqrt(variance)); };
  totals.tvu[i] = at_coverage(HeightVariance(total, gradient) + of_footprint);
  totals.tvu_air[i] = at_coverage(HeightVariance(Entries(totals.air, i), gradient) + of_footprint);
  for (std::size_t group = 0; group < kErrorGroups; ++group) {
    double variance = HeightVariance(Entries(totals.groups[group], i), gradient);
    if (group == static_cast<std::size_t>(ErrorGroup::kPulse)) variance += of_footprint;
    totals.groups[group][kDown][i] = static_cast<float>(variance);
  }
  return {.slope = static_cast<float>(std::atan(std::hypot(gradient.north, gradient.east)) * 180 / std::numbers::pi),
          .tvu_slope = at_coverage(SlopeVariance(total, gradient)),
          .tvu_footprint = at_coverage(of_footprint)};
}

}  // namespace albtpu::annotate
