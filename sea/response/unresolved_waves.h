// The effect of waves shorter than the grid on the mean direction of a beam.
//
// Their slopes average out over the footprint, but refraction is not linear in slope. They shift the mean tangent and
// the mean secant of the refracted rays (the biases; at nadir the path lengthens by 1/2 g^2 times their mean square
// slope), and they change the response of a ray to the resolved waves by a few per cent in strong wind, in first
// order and, for vertical errors near nadir, in second order. See "Waves shorter than the grid" in docs/physics.md.
#pragma once

#include <Eigen/Core>

#include "sea/response/footprint.h"

namespace albtpu {

// The change of (tangent x, tangent y, secant) of a refracted ray as a polynomial in the resolved slope at the ray:
// `offset + gain * slope + curvature * SlopeSquares(slope)`. It is linear in the slope and its squares, so
// their means over the rays give the change of the mean.
struct UnresolvedWaves {
  Eigen::Vector3d offset;
  Eigen::Matrix<double, 3, 2> gain;
  Eigen::Matrix3d curvature;
};

// (m_x^2, m_y^2, m_x m_y).
inline Eigen::Vector3d SlopeSquares(const Eigen::Vector2d& slope) {
  return {slope.x() * slope.x(), slope.y() * slope.y(), slope.x() * slope.y()};
}

// A facet of slope m stands for a patch of water with the slopes m + delta, where delta is normal with the covariance
// `unresolved`: that of the sea less that of the facets, `resolved`. (All cells are cut along the same diagonal, which
// correlates the two slopes of the facets; the slopes of the sea have no such correlation, and the difference removes
// it.) Rays see the slopes with the weight of the facing area, 1 + tan(theta) (m + delta) . phi. The mean over delta is
// taken by quadrature. Of its difference from the value at delta = 0 the result is the first two orders in Hermite
// polynomials of the resolved slopes: their mean response to it, not that at m = 0.
UnresolvedWaves EffectOfUnresolvedWaves(const BeamOptions& beam, double refractive_index,
                                        const Eigen::Matrix2d& unresolved, const Eigen::Matrix2d& resolved);

}  // namespace albtpu
