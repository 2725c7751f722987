// What waves shorter than the grid do to the mean direction of a beam.
//
// They average out over the footprint, but refraction is not linear in slope: they shift the mean tangent and
// the mean secant of the refracted rays (the biases; at nadir the path lengthens by 1/2 g^2 times their mean
// square slope), and change, by a few per cent in strong wind, how much a ray answers to the waves that are
// resolved, in first and, for vertical errors near nadir, in second order.
#pragma once

#include <Eigen/Core>

#include "sea/response/footprint.h"

namespace albtpu {

// The change of (tangent x, tangent y, secant) of a refracted ray as a polynomial in the resolved slope that it
// meets: `offset + gain * slope + curvature * SlopeSquares(slope)`. It is linear in the slope and its squares, so
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

// A facet of slope m stands for a patch of water with the slopes m + delta, delta normal with
// `slope_covariance` (that of the sea less that of the facets: the cut along one diagonal makes the facets'
// slopes go together, which the sea's do not, and this takes it back). Rays see the slopes with the weight of
// the facing area, 1 + tan(theta) (m + delta) . phi. The mean over delta is taken by quadrature, its
// departure from delta = 0 expanded to second order in m.
UnresolvedWaves EffectOfUnresolvedWaves(const BeamOptions& beam, double refractive_index,
                                        const Eigen::Matrix2d& slope_covariance);

}  // namespace albtpu
