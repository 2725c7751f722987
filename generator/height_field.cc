#include "generator/height_field.h"

#include <cassert>
#include <utility>

#include "generator/ray_meeting.h"

namespace albtpu {

HeightField::HeightField(std::vector<double> heights, int points, double spacing)
    : heights_(std::move(heights)), points_(points), spacing_(spacing), points_per_metre_(1 / spacing) {
  assert(points >= 3 && points % 2 == 1 && spacing > 0);
  assert(heights_.size() == static_cast<std::size_t>(points) * points);
}

HeightField::Facet HeightField::FacetOf(const Triangle& triangle) const {
  const auto [ix, iy, beside_x] = triangle;
  const double* low = &heights_[static_cast<std::size_t>(ix) * points_ + iy];
  const double* high = low + points_;
  // From the low corner to the high one: first along x, then along y, or the other way round. Which of them is
  // as good as random, so that addresses are chosen and not branches.
  const int first = beside_x ? 0 : 1;
  const double* last = beside_x ? high : low;
  const Eigen::Vector2d rise(high[first] - low[first], last[1] - last[0]);
  const int centre = (points_ - 1) / 2;
  return {low[0] - rise.dot(Eigen::Vector2d(ix - centre, iy - centre)), rise * points_per_metre_};
}

Hit Intersect(const HeightField& surface, const Ray& ray) { return Meet(surface, ray); }

}  // namespace albtpu
