// Statistics of the slopes over which a beam averages, at the facets that its rays would meet if the height of the
// water did not shift them. The mean slope is then linear in the heights and the mean square quadratic, so the
// statistics of both are known without drawing a surface. A beam's refraction follows them to first and second order:
// they are the control variates of the Monte Carlo.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "generator/monte_carlo/surface_correlation.h"
#include "generator/surface/beam.h"

namespace albtpu {

struct SlopeMoments {
  Eigen::Matrix2d covariance;        // of the mean slope
  Eigen::Vector3d expected_squares;  // of the mean of (m_x^2, m_y^2, m_x m_y)
  double variance_of_form;           // of the mean of m^T form m
};

// The moments over the facets above or below the points where `rays` cross z = 0. With R(a, b) the covariance matrix of
// the slopes of facets a and b, and w their fractions of the rays,
//     covariance = sum w_a w_b R(a, b),    variance_of_form = 2 sum w_a w_b tr(form R(a, b) form R(a, b)^T).
// The second is Isserlis' theorem for Gaussian slopes of mean zero, cov(m_ai m_aj, m_bk m_bl) = R_ik R_jl + R_il R_jk,
// with a symmetric `form`. Exact for the waves of `correlation`, which must reach as far as the rays lie apart.
SlopeMoments MomentsOfSlopes(const SurfaceCorrelation& correlation, const std::vector<Ray>& rays,
                             double spacing, const Eigen::Matrix2d& form);

// The covariance of the slope averaged over the footprint of a collimated beam itself. Rays only sample it: they alias
// some of the waves that are too short for their spacing to longer ones.
Eigen::Matrix2d FootprintSlopeCovariance(const SurfaceCorrelation& correlation, const BeamOptions& beam,
                                         double spacing);

// The largest distance between two rays along an axis, in cells with the side `spacing` [m].
int ReachOfRays(const std::vector<Ray>& rays, double spacing);

}  // namespace albtpu
