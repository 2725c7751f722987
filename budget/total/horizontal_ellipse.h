// The ellipse of a horizontal covariance.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace albtpu {

struct HorizontalEllipse {
  double semi_major, semi_minor;  // m, 1 sigma.
  double major_azimuth;           // degree from north, clockwise, 0 to 180; 0 of a circle.
};

// Of variances to the north and east and their covariance, m^2.
inline HorizontalEllipse EllipseOf(double nn, double ee, double ne) {
  const double mean = (nn + ee) / 2, split = std::hypot((nn - ee) / 2, ne);
  const double turn = split > 0 ? std::atan2(2 * ne, nn - ee) * (90 / std::numbers::pi) : 0;
  return {std::sqrt(mean + split), std::sqrt(std::max(mean - split, 0.0)), turn < 0 ? turn + 180 : turn};
}

}  // namespace albtpu
