// The covariance of height and slope within a footprint, which displaces a beam at the depth 0.
#pragma once

#include <Eigen/Core>
#include <array>

#include "generator/math/fft.h"
#include "generator/monte_carlo/surface_correlation.h"
#include "generator/surface/beam.h"

namespace albtpu {

// With <> the mean over a footprint, q = <h m> - <h> <m> is the covariance of height h and slope m within it, a vector
// in m. Rays that enter the water high travel farther in it before they reach the mean height; where these rays are
// also refracted more, the spot moves. To second order in slope, the error at depth 0 is q times the gains of Snell's
// law.
//
// Immutable; serves all beams through one sea.
class HeightSlopeProduct {
 public:
  // `correlation` must reach as far as the footprints are wide, in cells of the side `spacing` [m].
  HeightSlopeProduct(const SurfaceCorrelation& correlation, double spacing);

  // E[q q^T], m^2, for the footprint of a collimated beam. E[q] = 0 because the footprint is symmetric.
  //
  // Derivation: q is a sum over pairs of points, K_ij h_i m_j with K = diag(w) - w w^T and the weights w of the points.
  // By Wick's theorem for Gaussian waves,
  //     E[q_a q_b] = sum K_ij K_kl (E[h_i h_k] E[m_aj m_bl] + E[h_i m_bl] E[m_aj h_k]).
  // Let C, G and R be the covariances of two heights, of height and slope, and of two slopes, as functions of the lag;
  // G is odd in it, which gives the minus signs. C- is C averaged over the footprint for one of its points, and C= for
  // both; G= vanishes. The sum is
  //     sum w_i w_j (C R_ab - G_a G_b)(i - j) - 2 sum w_i (C- R-_ab - G-_a G-_b)(i) + C= R=_ab.
  // A constant added to C has no effect, because the rows and columns of K sum to zero.
  Eigen::Matrix2d Covariance(const BeamOptions& beam) const;

 private:
  // The Fourier transform of a function of the lag, on a grid of size_ cells.
  Eigen::MatrixXcd Transform(const Eigen::MatrixXd& of_lags) const;

  double spacing_;
  int reach_;  // from the centre of the footprints to their edge, in cells
  int size_;
  InverseFft transform_;
  Eigen::MatrixXcd height_;
  std::array<Eigen::MatrixXcd, 2> height_slope_;
  std::array<Eigen::MatrixXcd, 3> slopes_;    // xx, xy, yy, as in products_
  std::array<Eigen::MatrixXcd, 3> products_;  // C R_ab - G_a G_b
};

}  // namespace albtpu
