// How height and slope go together within a footprint: what displaces a beam before it has any depth.
#pragma once

#include <Eigen/Core>
#include <array>

#include "generator/monte_carlo/surface_correlation.h"
#include "generator/surface/beam.h"

namespace albtpu {

// With <> the mean over a footprint, q = <h m> - <h> <m> is the covariance of height h and slope m within it, a
// vector in m. Rays that meet the water high go farther in it before they reach the mean height, and where
// they are also the ones that are turned, the spot moves: the error at depth 0 is q times the gains of Snell's
// law, to second order in slope.
//
// Immutable, for all beams through one sea.
class HeightSlopeProduct {
 public:
  // `correlation` must reach as far as the footprints are wide, in cells of the side `spacing` [m].
  HeightSlopeProduct(const SurfaceCorrelation& correlation, double spacing);

  // E[q q^T], m^2, for the footprint of a collimated beam; E[q] = 0, as the footprint looks alike from both
  // sides. q is a sum over pairs of points, K_ij h_i m_j with K = diag(w) - w w^T, and by Wick's theorem for
  // Gaussian waves E[q_a q_b] = sum K_ij K_kl (E[h_i h_k] E[m_aj m_bl] + E[h_i m_bl] E[m_aj h_k]). With
  // C, G and R for the covariances of heights, of height and slope and of slopes, and a bar for what the
  // footprint's average leaves of them, that is
  //     sum w_i w_j (C R_ab - G_a G_b)(i - j) - 2 sum w_i (C- R-_ab - G-_a G-_b)(i) + C= R=_ab.
  // A constant in C drops out, K having no sum.
  Eigen::Matrix2d Covariance(const BeamOptions& beam) const;

 private:
  // Transformed, on a grid of size_ cells.
  Eigen::MatrixXcd Transform(const Eigen::MatrixXd& of_lags) const;

  double spacing_;
  int reach_;  // of the footprints from their centre, in cells
  int size_;
  Eigen::MatrixXcd height_;
  std::array<Eigen::MatrixXcd, 2> height_slope_;
  std::array<Eigen::MatrixXcd, 3> slopes_;    // xx, xy, yy, as the next
  std::array<Eigen::MatrixXcd, 3> products_;  // C R_ab - G_a G_b
};

}  // namespace albtpu
