// The slopes that a beam averages over, as its rays would meet them were the water's height not to shift the
// rays: their mean is linear in the heights and the mean of their squares quadratic, so that the statistics
// of both are known without drawing a surface. They are what a beam's refraction follows, to first and to
// second order: the control variates of the Monte Carlo.
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

// Of the facets over which `rays` cross z = 0. With R(a, b) the covariance matrix of the slopes of facets a
// and b and w their shares of the rays, slopes being Gaussian of mean zero,
//     covariance = sum w_a w_b R(a, b),    variance_of_form = 2 sum w_a w_b tr(form R(a, b) form R(a, b)^T).
// `form` is symmetric. Exact for the waves of `correlation`, which must reach as far as the rays lie apart.
SlopeMoments MomentsOfSlopes(const SurfaceCorrelation& correlation, const std::vector<Ray>& rays,
                             double spacing, const Eigen::Matrix2d& form);

// The covariance of the slope averaged over the footprint of a collimated beam itself, of which rays are a
// sample: these see some of the waves that are too short for their spacing, as if they were long ones.
Eigen::Matrix2d FootprintSlopeCovariance(const SurfaceCorrelation& correlation, const BeamOptions& beam,
                                         double spacing);

// How many cells of the side `spacing` the rays lie apart, at most, along an axis.
int ReachOfRays(const std::vector<Ray>& rays, double spacing);

}  // namespace albtpu
