// Covariances of the water's slopes and heights between two points, by the vector between them.
#pragma once

#include <Eigen/Core>

#include "sea/response/beam_spectrum.h"

namespace albtpu {

// In the coordinates across a beam: one row for each of the lags 0, FootprintKernel::kLagStride, ... of the lattice,
// one column for each of `directions`.
//
// Derivation: with P as in BeamSpectrum and g the harmonics of P kappa_a kappa_b, the integral of P kappa_a kappa_b
// cos(kappa s cos(psi - beta)) d(psi) is the sum over all l of (-1)^l g_l J_2l(kappa s) exp(2 i l beta). With h the
// factors of exp(i (2 l + 1) psi) in P kappa_c, that of P kappa_c sin(kappa s cos(psi - beta)) is the sum over all l of
// (-1)^l h_l J_(2l+1)(kappa s) exp(i (2 l + 1) beta).
struct LagCovariances {
  LagCovariances(const BeamSpectrum& spectrum, int lags);

  // The directions beta of the lag from the azimuth, rad: evenly over half a turn, as many as means over all directions
  // of products of two of the following need.
  Eigen::ArrayXd directions;
  // R_xx, R_xy and R_yy of the slopes.
  Eigen::ArrayXXd along, both, across;
  // Half the mean square of the difference of two heights, D, m^2: the variance less the covariance of heights.
  Eigen::ArrayXXd height;
  // dD/dx and dD/dy, times the lag, m^2.
  Eigen::ArrayXXd height_along, height_across;
};

// Means over all directions beta of the lag of products, one row per lag. Slopes are in the order (along, along),
// (along, across), (across, across).
struct LagProducts {
  explicit LagProducts(const LagCovariances& covariances);

  // R_ab R_cd in the order 0-0, 0-1, 0-2, 1-1, 1-2, 2-2 of slopes.
  Eigen::MatrixXd slope_pairs;
  // D^2 n_a n_b, with n = (cos(beta), sin(beta)), in the order of slopes.
  Eigen::MatrixXd squared_heights;
  // R_ab and D R_ab, and both times cos(2 beta).
  Eigen::MatrixXd slopes, turned_slopes, height_slopes, turned_height_slopes;
  // s dD/dx R_ab cos(beta), then s dD/dy R_ab cos(beta).
  Eigen::MatrixXd gradient_slopes;
};

}  // namespace albtpu
