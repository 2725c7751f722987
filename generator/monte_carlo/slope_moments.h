// Known statistics of the slopes under a beam, the control variates of the Monte Carlo: the covariances of heights and
// slopes, their product within a footprint, and the moments of slopes over the facets of a beam.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "generator/math/fft.h"
#include "generator/surface/beam.h"
#include "generator/surface/sea_surface.h"

namespace albtpu {

// Covariances of the heights and slopes of a surface between two points.

// Covariances of heights and slopes as functions of the lag, for the waves of a SurfaceModel, all of which are
// stationary. Exact for the modes of the patch and for the plane waves. (A local surface holds an interpolation of the
// plane waves, whose slopes are accurate to 1e-3 or better.) Immutable.
class SurfaceCorrelation {
 public:
  // For lags up to `reach` cells along each axis; less than half the patch.
  SurfaceCorrelation(const SurfaceModel& model, int reach);

  int reach() const { return reach_; }

  // Of the slopes of two sides of triangles, by the lag in cells between their midpoints. Two sides along x are whole
  // cells apart, and so are two sides along y. A side along x and one along y are offset by half a cell on both axes:
  // xy is at the lag (lag_x + 1/2, lag_y + 1/2).
  double xx(int lag_x, int lag_y) const { return At(xx_, lag_x, lag_y); }
  double yy(int lag_x, int lag_y) const { return At(yy_, lag_x, lag_y); }
  double xy(int lag_x, int lag_y) const { return At(xy_, lag_x, lag_y); }

  // At the points of the grid, where the slope is that of a side centred on the point. The lag (i, j) is at the element
  // (i + reach(), j + reach()).
  struct AtPoints {
    // E[h(0) h(lag)] - E[h^2], m^2. Only differences of height matter within a footprint, and the variance of the long
    // waves would swamp them.
    Eigen::MatrixXd height;
    Eigen::MatrixXd height_x, height_y;            // E[h(0) slope(lag)], m
    Eigen::MatrixXd slope_xx, slope_xy, slope_yy;  // E[slope(0) slope(lag)]
  };
  const AtPoints& at_points() const { return at_points_; }

 private:
  double At(const Eigen::MatrixXd& covariance, int lag_x, int lag_y) const {
    return covariance(lag_x + reach_, lag_y + reach_);
  }

  int reach_;
  Eigen::MatrixXd xx_, yy_, xy_;  // the lag along x is the row
  AtPoints at_points_;
};

// The covariance of height and slope within a footprint, which displaces a beam at the depth 0.

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

// Statistics of the slopes over which a beam averages, at the facets that its rays would meet if the height of the
// water did not shift them. The mean slope is then linear in the heights and the mean square quadratic, so the
// statistics of both are known without drawing a surface. A beam's refraction follows them to first and second order:
// they are the control variates of the Monte Carlo.
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
SlopeMoments MomentsOfSlopes(const SurfaceCorrelation& correlation, const std::vector<Ray>& rays, double spacing,
                             const Eigen::Matrix2d& form);

// The covariance of the slope averaged over the footprint of a collimated beam itself. Rays only sample it: they alias
// some of the waves that are too short for their spacing to longer ones.
Eigen::Matrix2d FootprintSlopeCovariance(const SurfaceCorrelation& correlation, const BeamOptions& beam,
                                         double spacing);

// The largest distance between two rays along an axis, in cells with the side `spacing` [m].
int ReachOfRays(const std::vector<Ray>& rays, double spacing);

}  // namespace albtpu
