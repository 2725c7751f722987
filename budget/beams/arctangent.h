// The angle of a plane vector by a fixed sequence of IEEE operations: other languages can compute the same bits.
#pragma once

#include <cmath>
#include <numbers>

namespace albtpu {

// The angle of the vector (x, y) from the x axis, in [-pi, pi] rad, as std::atan2(y, x): within 1e-15 rad of the exact
// angle (four roundings of numbers below pi, and 1e-17 of the polynomial). It differs from std::atan2 in that zeros
// have no sign: the angle of (0, 0) is 0, and that of (x, -0) is 0 or pi. If x or y is NaN or both are infinite, the
// angle is NaN.
//
// The vector is mirrored into the octant 0 <= y <= x and, where its angle is above pi/8, turned back by pi/4:
// tan(a - pi/4) = (y - x) / (y + x). What remains is the arctangent of |v| <= tan(pi/8) as v + v z Q(z), z = v^2.
//
// Sources that include this must be compiled without contraction of a * b + c (-ffp-contract=off).
inline double Arctangent(double y, double x) {
  constexpr double kTangentOfEighthPi = 0.41421356237309503;  // sqrt(2) - 1
  const double along = std::abs(x), across = std::abs(y);
  const bool steep = along < across;
  const double longer = steep ? across : along, shorter = steep ? along : across;
  const bool turned = shorter > kTangentOfEighthPi * longer;
  const double numerator = turned ? shorter - longer : shorter;
  const double denominator = turned ? shorter + longer : longer;
  const double v = numerator / (denominator == 0 ? 1.0 : denominator);
  const double z = v * v;
  // Q minimizes the largest error of v z Q(z) over z in [0, tan(pi/8)^2], by Remez' algorithm in 40 digits: 8e-18.
  double q = 0.020660413422554418;
  q = q * z + -0.04305973833246121;
  q = q * z + 0.05672436898369194;
  q = q * z + -0.06636885171566724;
  q = q * z + 0.07689524976703539;
  q = q * z + -0.09090738891781402;
  q = q * z + 0.11111104507599112;
  q = q * z + -0.14285714133696484;
  q = q * z + 0.1999999999818374;
  q = q * z + -0.33333333333325194;
  const double small = v + v * z * q;
  const double in_octant = turned ? std::numbers::pi / 4 + small : small;
  const double in_quadrant = steep ? std::numbers::pi / 2 - in_octant : in_octant;
  const double above = x < 0 ? std::numbers::pi - in_quadrant : in_quadrant;
  return y < 0 ? -above : above;
}

}  // namespace albtpu
