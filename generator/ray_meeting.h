// Where a ray meets a surface that is made of triangles over a grid.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "generator/height_field.h"

namespace albtpu {

// The meeting of `ray` and `surface`, exact, on the plane of one triangle; `surface` has TriangleAt, FacetOf
// and reach as HeightField, see Intersect.
template <typename Surface>
Hit Meet(const Surface& surface, const Ray& ray) {
  constexpr int kMostSteps = 100;
  constexpr double kLeastApproach = 0.1;  // a step goes the right way even over a facet that turns away
  const Eigen::Vector2d per_height = ray.per_height();
  double below = -std::numeric_limits<double>::infinity();  // heights at which the ray is known to be under
  double above = std::numeric_limits<double>::infinity();   // and over the surface
  double z = 0;
  HeightField::Triangle triangle = surface.TriangleAt(ray.at_zero);
  HeightField::Facet facet;
  for (int step = 0; step < kMostSteps; ++step) {
    facet = surface.FacetOf(triangle);
    const double clearance = z - facet.HeightAt(ray.at_zero + z * per_height);
    (clearance < 0 ? below : above) = z;
    // The meeting with the plane of the facet under the ray; if it lies outside of what is known, which then
    // is finite, halve what is known.
    const double approach = 1 - facet.slope.dot(per_height);
    double next = z - clearance / std::max(kLeastApproach, approach);
    const bool on_the_plane = next >= below && next <= above && approach >= kLeastApproach;
    if (!(next >= below && next <= above)) next = 0.5 * (below + above);
    const HeightField::Triangle under = surface.TriangleAt(ray.at_zero + next * per_height);
    const bool settled = (on_the_plane && under == triangle) || std::abs(next - z) <= 1e-12 * surface.reach();
    z = next;
    if (settled) break;
    triangle = under;
  }
  return {z, facet};
}

}  // namespace albtpu
