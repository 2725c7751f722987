#include "generator/surface/ray_tracer.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace albtpu {
namespace {

// Newton's method on the facet under the ray, with bisection as a safeguard. `surface` has TriangleAt, FacetOf and
// reach as HeightField does.
template <typename Surface>
Hit IntersectTriangles(const Surface& surface, const Ray& ray) {
  constexpr int kMaxSteps = 100;
  constexpr double kMinApproach = 0.1;  // keeps the direction of a step right even over a facet that turns away
  const Eigen::Vector2d per_height = ray.per_height();
  // Heights at which the ray is known to be below and above the surface: they bracket the intersection.
  double below = -std::numeric_limits<double>::infinity();
  double above = std::numeric_limits<double>::infinity();
  double z = 0;
  HeightField::Triangle triangle = surface.TriangleAt(ray.at_zero);
  HeightField::Facet facet;
  for (int step = 0; step < kMaxSteps; ++step) {
    facet = surface.FacetOf(triangle);
    const double clearance = z - facet.HeightAt(ray.at_zero + z * per_height);
    (clearance < 0 ? below : above) = z;
    // Go to the intersection with the plane of the facet under the ray. Where that is outside the bracket, which is
    // then finite, bisect the bracket.
    const double approach = 1 - facet.slope.dot(per_height);
    double next = z - clearance / std::max(kMinApproach, approach);
    const bool on_the_plane = next >= below && next <= above && approach >= kMinApproach;
    if (!(next >= below && next <= above)) next = 0.5 * (below + above);
    const HeightField::Triangle under = surface.TriangleAt(ray.at_zero + next * per_height);
    const bool settled = (on_the_plane && under == triangle) || std::abs(next - z) <= 1e-12 * surface.reach();
    z = next;
    if (settled) break;
    triangle = under;
  }
  return {z, facet};
}

}  // namespace

HeightField::HeightField(std::vector<double> heights, int points, double spacing)
    : heights_(std::move(heights)), points_(points), spacing_(spacing), points_per_metre_(1 / spacing) {
  assert(points >= 3 && points % 2 == 1 && spacing > 0);
  assert(heights_.size() == static_cast<std::size_t>(points) * points);
}

HeightField::Facet HeightField::FacetOf(const Triangle& triangle) const {
  const auto [ix, iy, beside_x] = triangle;
  const double* low = &heights_[static_cast<std::size_t>(ix) * points_ + iy];
  const double* high = low + points_;
  // From the low corner to the high one, first along x and then along y, or the other way round. The choice is as good
  // as random, so it selects addresses and does not branch.
  const int first = beside_x ? 0 : 1;
  const double* last = beside_x ? high : low;
  const Eigen::Vector2d rise(high[first] - low[first], last[1] - last[0]);
  const int centre = (points_ - 1) / 2;
  return {low[0] - rise.dot(Eigen::Vector2d(ix - centre, iy - centre)), rise * points_per_metre_};
}

HeightField::Triangle HeightView::TriangleAt(const Eigen::Vector2d& x) const {
  const double last_cell = points - 2;
  const Eigen::Vector2d at = (x / static_cast<double>(spacing)).array() + (points - 1) / 2;
  const int ix = static_cast<int>(std::clamp(at.x(), 0.0, last_cell));
  const int iy = static_cast<int>(std::clamp(at.y(), 0.0, last_cell));
  return {ix, iy, at.x() - ix > at.y() - iy};
}

HeightField::Facet HeightView::FacetOf(const HeightField::Triangle& triangle) const {
  const auto [ix, iy, beside_x] = triangle;
  const float* low = heights + ix * stride + iy;
  const float* high = low + stride;
  const double third = beside_x ? high[0] : low[1];
  const double from_low = third - low[0], to_high = high[1] - third;
  const Eigen::Vector2d rise(beside_x ? from_low : to_high, beside_x ? to_high : from_low);
  const int centre = (points - 1) / 2;
  return {low[0] - rise.dot(Eigen::Vector2d(ix - centre, iy - centre)), rise / static_cast<double>(spacing)};
}

Hit Intersect(const HeightField& surface, const Ray& ray) { return IntersectTriangles(surface, ray); }

Hit Intersect(const HeightView& surface, const Ray& ray) { return IntersectTriangles(surface, ray); }

TracedBeam Trace(const std::vector<Ray>& rays, const HeightField& surface, double refractive_index) {
  assert(!rays.empty());
  TracedBeam sum{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), 0, 0,
                 Eigen::Vector2d::Zero(), Eigen::Vector3d::Zero()};
  double height = 0;
  for (const Ray& ray : rays) {
    const Hit hit = Intersect(surface, ray);
    const auto [tangent, secant] = RefractAtSlope(ray.direction, hit.facet.slope, refractive_index);
    height += hit.height;
    sum.tangent += tangent;
    sum.height_tangent += hit.height * tangent;
    sum.secant += secant;
    sum.height_secant += hit.height * secant;
    sum.slope += hit.facet.slope;
    sum.slope_squares += SlopeSquares(hit.facet.slope);
  }
  const double count = static_cast<double>(rays.size());
  TracedBeam mean{sum.tangent / count,       sum.height_tangent / count, sum.secant / count,
                  sum.height_secant / count, sum.slope / count,          sum.slope_squares / count};
  // From heights above z = 0 to heights above their mean.
  mean.height_tangent -= height / count * mean.tangent;
  mean.height_secant -= height / count * mean.secant;
  return mean;
}

TracedBeam WithUnresolvedWaves(TracedBeam beam, const UnresolvedWaves& unresolved) {
  const Eigen::Vector3d change =
      unresolved.offset + unresolved.gain * beam.slope + unresolved.curvature * beam.slope_squares;
  beam.tangent += change.head<2>();
  beam.secant += change.z();
  return beam;
}

}  // namespace albtpu
