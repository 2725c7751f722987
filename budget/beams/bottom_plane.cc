#include "budget/beams/bottom_plane.h"

#include <Eigen/LU>
#include <cmath>

namespace albtpu {

void PlaneSums::Add(double dx, double dy, double dz, double weight) {
  n += weight, x += weight * dx, y += weight * dy, z += weight * dz;
  xx += weight * dx * dx, xy += weight * dx * dy, yy += weight * dy * dy;
  xz += weight * dx * dz, yz += weight * dy * dz;
}

PlaneSums PlaneSums::About(double dx, double dy) const {
  PlaneSums m = *this;
  m.x = x - n * dx, m.y = y - n * dy;
  m.xx = xx - 2 * dx * x + n * dx * dx, m.yy = yy - 2 * dy * y + n * dy * dy;
  m.xy = xy - dx * y - dy * x + n * dx * dy;
  m.xz = xz - dx * z, m.yz = yz - dy * z;
  return m;
}

PlaneSums& PlaneSums::operator+=(const PlaneSums& o) {
  n += o.n, x += o.x, y += o.y, z += o.z, xx += o.xx, xy += o.xy, yy += o.yy, xz += o.xz, yz += o.yz;
  return *this;
}

Plane PlaneOf(const PlaneSums& m, double side) {
  Plane plane;
  if (m.n < 4) return plane;
  Eigen::Matrix2d spread;
  spread << m.xx - m.x * m.x / m.n, m.xy - m.x * m.y / m.n, m.xy - m.x * m.y / m.n, m.yy - m.y * m.y / m.n;
  const double least_spread = spread.trace() / 2 - std::hypot((spread(0, 0) - spread(1, 1)) / 2, spread(0, 1));
  constexpr double kLeast = 0.3;  // Of a cell: evenly spread over 3 cells, points have 0.87.
  if (!(least_spread / m.n > kLeast * kLeast * side * side)) return plane;
  plane.of_unit_noise = spread.inverse();
  plane.middle = Eigen::Vector2d(m.x, m.y) / m.n;
  plane.slope = plane.of_unit_noise * Eigen::Vector2d(m.xz - m.x * m.z / m.n, m.yz - m.y * m.z / m.n);
  plane.has_slope = true;
  return plane;
}

}  // namespace albtpu
