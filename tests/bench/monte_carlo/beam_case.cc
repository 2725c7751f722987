#include "tests/bench/monte_carlo/beam_case.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "sea/response/closed_form.h"

namespace albtpu::bench {
namespace {

constexpr std::uint64_t kSeed = 20;
// The width of the surface over that of the footprint: some cells at the edge, and the shift of rays by waves of a
// tenth of the footprint's width.
double Margin(double incidence) { return 1.02 + 0.2 * std::tan(incidence); }

double WidthOnWater(const CaseOptions& options) { return options.footprint / std::cos(options.incidence); }

double PatchLength(const CaseOptions& options) { return options.patch_per_beam * WidthOnWater(options); }

CrossFade PatchShare(double length) {  // as in SurfaceModel
  const double dk = 2 * std::numbers::pi / length;
  return CrossFade(3 * dk, 6 * dk);
}

// The interleaved bits of a and b: points that are close in the plane are mostly close in this order.
std::uint64_t Morton(std::uint32_t a, std::uint32_t b) {
  std::uint64_t code = 0;
  for (int bit = 0; bit < 16; ++bit) {
    code |= static_cast<std::uint64_t>(a >> bit & 1) << (2 * bit + 1);
    code |= static_cast<std::uint64_t>(b >> bit & 1) << (2 * bit);
  }
  return code;
}

// All rays are within `reach` [m] of the centre. The curve visits cells with the side `spacing` [m].
FloatRays AlongMortonCurve(const std::vector<Ray>& rays, double reach, double spacing) {
  const auto cell = [&](double x) { return static_cast<std::uint32_t>((x + reach) / spacing); };
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (const Ray& ray : rays) order.emplace_back(Morton(cell(ray.at_zero.x()), cell(ray.at_zero.y())), order.size());
  std::sort(order.begin(), order.end());
  FloatRays sorted{{}, {}, rays.front().direction};
  for (const auto& [place, r] : order) {
    sorted.x.push_back(static_cast<float>(rays[r].at_zero.x()));
    sorted.y.push_back(static_cast<float>(rays[r].at_zero.y()));
  }
  return sorted;
}

}  // namespace

BeamCase::BeamCase(const CaseOptions& options)
    : options_(options),
      patch_(SeaState(options.wind_speed, std::numeric_limits<double>::infinity()), PatchLength(options), options.size,
             PatchShare(PatchLength(options))),
      beam_(options.BeamOf(), options.rays),
      rays_(beam_.Rays(0)),
      bundle_(beam_, kRefractiveIndex),
      sorted_(AlongMortonCurve(rays_, WidthOnWater(options), patch_.spacing())) {
  const double half = Margin(options.incidence) * WidthOnWater(options) / 2 / patch_.spacing();
  footprint_points_ = 2 * static_cast<int>(std::ceil(half)) + 1;
}

double BeamCase::ModePower(int i, int j) const {
  const int size = options_.size;
  if (std::abs(i) >= size / 2 || std::abs(j) >= size / 2) return 0;
  if (j < 0) return ModePower(-i, -j);
  return patch_.power(i < 0 ? i + size : i, j);
}

std::vector<Ray> BeamCase::SortedRays() const {
  std::vector<Ray> rays;
  for (std::size_t r = 0; r < sorted_.x.size(); ++r) rays.push_back({sorted_.direction, {sorted_.x[r], sorted_.y[r]}});
  return rays;
}

NormalStream BeamCase::Stream(std::uint32_t realization) { return {kSeed, 0, realization}; }

FloatSurface BeamCase::Draw(std::uint32_t realization, int points) const {
  const std::vector<double> patch = patch_.Draw(Stream(realization));
  const int size = options_.size;
  const int first = size - (points - 1) / 2;  // the patch repeats
  FloatSurface surface{{}, points, static_cast<float>(patch_.spacing())};
  surface.heights.reserve(static_cast<std::size_t>(points) * points);
  for (int i = 0; i < points; ++i) {
    for (int j = 0; j < points; ++j) {
      const std::size_t at = static_cast<std::size_t>((first + i) % size) * size + (first + j) % size;
      surface.heights.push_back(static_cast<float>(patch[at]));
    }
  }
  return surface;
}

BeamMeans MeansOf(const TracedBeam& traced) {
  return {.tangent_x = traced.tangent.x(),
          .tangent_y = traced.tangent.y(),
          .secant = traced.secant,
          .height_tangent_x = traced.height_tangent.x(),
          .height_tangent_y = traced.height_tangent.y(),
          .height_secant = traced.height_secant};
}

double Difference(const BeamMeans& a, const BeamMeans& b, double footprint) {
  return std::max({std::abs(a.tangent_x - b.tangent_x), std::abs(a.tangent_y - b.tangent_y),
                   std::abs(a.secant - b.secant), std::abs(a.height_tangent_x - b.height_tangent_x) / footprint,
                   std::abs(a.height_tangent_y - b.height_tangent_y) / footprint,
                   std::abs(a.height_secant - b.height_secant) / footprint});
}

Spots SpotsOf(const BeamMeans& means) {
  Spots spots;
  for (std::size_t d = 0; d < spots.size(); ++d) {
    spots[d] = {.x = means.height_tangent_x + kDepths[d] * means.tangent_x,
                .y = means.height_tangent_y + kDepths[d] * means.tangent_y,
                .path = means.height_secant + kDepths[d] * means.secant};
  }
  return spots;
}

}  // namespace albtpu::bench
