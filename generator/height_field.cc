#include "generator/height_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace albtpu {

HeightField::HeightField(std::vector<double> heights, int points, double spacing)
    : heights_(std::move(heights)), points_(points), spacing_(spacing) {
  assert(points >= 3 && points % 2 == 1 && spacing > 0);
  assert(heights_.size() == static_cast<std::size_t>(points) * points);
}

HeightField::Facet HeightField::FacetAt(const Eigen::Vector2d& x) const {
  const double centre = (points_ - 1) / 2;
  const double last_cell = points_ - 2;
  const Eigen::Vector2d at = (x / spacing_).array() + centre;
  const int ix = static_cast<int>(std::clamp(at.x(), 0.0, last_cell));
  const int iy = static_cast<int>(std::clamp(at.y(), 0.0, last_cell));
  const double* low = &heights_[static_cast<std::size_t>(ix) * points_ + iy];
  const double* high = low + points_;
  Eigen::Vector2d rise;
  if (at.x() - ix > at.y() - iy) {
    rise = {high[0] - low[0], high[1] - high[0]};  // first along x, then along y
  } else {
    rise = {high[1] - low[1], low[1] - low[0]};  // first along y, then along x
  }
  const Eigen::Vector2d slope = rise / spacing_;
  const Eigen::Vector2d corner((ix - centre) * spacing_, (iy - centre) * spacing_);
  return {low[0] - slope.dot(corner), slope};
}

Hit Intersect(const HeightField& surface, const Ray& ray) {
  constexpr int kMostSteps = 100;
  constexpr double kLeastApproach = 0.1;  // a step goes the right way even over a facet that turns away
  const Eigen::Vector2d per_height = ray.per_height();
  double below = -std::numeric_limits<double>::infinity();  // heights at which the ray is known to be under
  double above = std::numeric_limits<double>::infinity();   // and over the surface
  double z = 0;
  HeightField::Facet facet;
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::Vector2d x = ray.at_zero + z * per_height;
    facet = surface.FacetAt(x);
    const double clearance = z - facet.HeightAt(x);
    (clearance < 0 ? below : above) = z;
    // The meeting with the plane of the facet under the ray; if it lies outside of what is known, which then
    // is finite, halve what is known.
    double next = z - clearance / std::max(kLeastApproach, 1 - facet.slope.dot(per_height));
    if (!(next >= below && next <= above)) next = 0.5 * (below + above);
    const bool settled = std::abs(next - z) <= 1e-12 * surface.reach();
    z = next;
    if (settled) break;
  }
  return {z, facet};
}

}  // namespace albtpu
