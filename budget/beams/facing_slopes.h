// The effect of waves on the mean of the beam directions that are derived from pairs of returns.
//
// Two effects do not average out over waves whose slopes m have the variance s^2 along each axis. A beam meets a facet
// with a probability proportional to the facet's area across the beam, 1 + m . t, t the horizontal vector of length
// tan(incidence): facets that face the beam are met more often. And refraction is not linear in the slope. To second
// order the mean of a function f(m) over the facets that are met is
//     f(0) + s^2 (t . grad f + (f_xx + f_yy) / 2).
// f is the angle in the plane of incidence between the ray of a pair (return_pair.h) and the true beam. Its mean is
// positive: rays seem flatter than they are, and a sensor where they meet would lie too low, by 0.15 % of its height at
// slopes of 0.07.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace albtpu {

struct FacingSlopes {
  double gain;  // Root mean square, over both components, of the angle of the ray per slope.
  double bias;  // Mean angle in the plane of incidence, rad, per s^2; positive away from nadir.
};

// For beams at `incidence` [rad], less than 1.2, into water of index `index`.
FacingSlopes FacingSlopesAt(double incidence, double index);

// The angle [rad] from the direction `v` to the ray's direction `u`, as a vector across v, less the mean that waves
// cause: `flattening` times the sine of the incidence of v, outward.
inline Eigen::Vector3d AngleBetween(const Eigen::Vector3d& v, const Eigen::Vector3d& u, double flattening) {
  const double cosine = u.dot(v);
  const Eigen::Vector3d across = u - cosine * v;
  const double sine = across.norm();
  const Eigen::Vector3d outward(-v.z() * v.x(), -v.z() * v.y(), 1 - v.z() * v.z());
  return across * (sine < 1e-12 ? 1 : std::atan2(sine, cosine) / sine) - flattening * outward;
}

}  // namespace albtpu
