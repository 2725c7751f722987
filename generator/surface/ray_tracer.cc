#include "generator/surface/ray_tracer.h"

#include <cassert>

#include "sea/response/refraction.h"

namespace albtpu {

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
