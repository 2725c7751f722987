#include "generator/height_window.h"

#include <algorithm>

namespace albtpu {

HeightField::Triangle HeightWindow::TriangleAt(const Eigen::Vector2d& x) const {
  const double last_cell = points - 2;
  const Eigen::Vector2d at = (x / static_cast<double>(spacing)).array() + (points - 1) / 2;
  const int ix = static_cast<int>(std::clamp(at.x(), 0.0, last_cell));
  const int iy = static_cast<int>(std::clamp(at.y(), 0.0, last_cell));
  return {ix, iy, at.x() - ix > at.y() - iy};
}

HeightField::Facet HeightWindow::FacetOf(const HeightField::Triangle& triangle) const {
  const auto [ix, iy, beside_x] = triangle;
  const float* low = heights + ix * stride + iy;
  const float* high = low + stride;
  const double third = beside_x ? high[0] : low[1];
  const double from_low = third - low[0], to_high = high[1] - third;
  const Eigen::Vector2d rise(beside_x ? from_low : to_high, beside_x ? to_high : from_low);
  const int centre = (points - 1) / 2;
  return {low[0] - rise.dot(Eigen::Vector2d(ix - centre, iy - centre)), rise / static_cast<double>(spacing)};
}

}  // namespace albtpu
