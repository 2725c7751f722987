// Covariances of slopes and heights under a footprint, first and second order, along and across the azimuth of the
// beam, from the spectrum of a sea as a slanted beam sees it.
#pragma once

#include <Eigen/Core>

#include "sea/quadrature/hankel_lattice.h"
#include "sea/response/footprint_kernel.h"
#include "sea/spectra/harmonic_spectrum.h"

namespace albtpu {

// The spectrum of a sea as a slanted beam sees it.
//
// On the water the footprint of a beam is an ellipse, longer by 1 / cos(incidence) along its azimuth. In the
// coordinates across the beam, x' = (cos(incidence) x along the azimuth, x across it), it is a circle. A wave of the
// wavenumber k has the wavenumber kappa there, k = (cos(incidence) kappa along, kappa across). In these coordinates
// all means over the footprint are integrals over one variable, wavenumber or lag.

// The harmonics of a spectrum about a beam: with P the elevation variance in d(ln kappa) d(psi), psi the direction from
// the azimuth across the beam, at the wavenumbers of the lattice
//     slope(i, m) = step kappa^2 integral over a turn of P exp(-2 i m psi) d(psi).
// The harmonic -m is the conjugate.
struct BeamSpectrum {
  double incidence;
  Eigen::MatrixXcd slope;  // wavenumber, harmonic

  int harmonics() const { return static_cast<int>(slope.cols()) - 1; }
};

// A sea on the wavenumbers of HankelLattice. Immutable.
class SlopeSpectrum {
 public:
  explicit SlopeSpectrum(const HarmonicSpectrum& spectrum);

  // Covariance of the slopes of all waves.
  Eigen::Matrix2d Covariance() const;

  BeamSpectrum AcrossBeam(double incidence, double azimuth) const;

 private:
  int harmonics_;
  Eigen::MatrixXd power_;  // step k^2 P(ln k, psi): the mean, then the factors of cos(2 n psi) and sin(2 n psi)
};

// Covariances of the water's slopes and heights between two points, by the vector between them.

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

// The covariance of height and slope within a footprint, which displaces a beam at the depth 0, from the spectrum.

// With <> the mean over the footprint, q = <h m> - <h> <m>, a vector along and across the azimuth. Returns E[q q^T],
// m^2.
//
// Derivation: Wick's theorem gives E[q_a q_b] as three means over the footprint ("Height and slope within the
// footprint" in docs/physics.md). With C the covariance of heights, that of height and slope is its gradient, and that
// of slopes less its second derivatives, so that C R_ab - G_a G_b = -1/2 d_a d_b C^2. With D = C(0) - C in place of C,
// which changes nothing, the autocorrelation a and the irradiance w of the footprint, D' = w * D and D" the mean of D
// over a,
//     E[q_a q_b] = -1/2 integral of a d_a d_b D^2 + integral of w d_a d_b D'^2 - D" V_ab.
Eigen::Matrix2d HeightSlopeCovariance(const BeamSpectrum& spectrum, const LagProducts& products,
                                      const FootprintKernel& footprint);

// Of the slope averaged over the footprint: V.
Eigen::Matrix2d FootprintSlopes(const BeamSpectrum& spectrum, const FootprintKernel& footprint);

// Half the mean square of the difference of the heights of two points of the footprint, m^2.
double HeightDifference(const BeamSpectrum& spectrum, const FootprintKernel& footprint);

// The means over pairs of points of the footprint of products of the elements (along, along), (along, across) and
// (across, across) of R, the covariance of the slopes at the two points.
Eigen::Matrix3d SlopePairs(const LagProducts& products, double incidence, const FootprintKernel& footprint);

// The mean of tr(G R H R).
double MeanOfForms(const Eigen::Matrix2d& g, const Eigen::Matrix2d& h, const Eigen::Matrix3d& pairs);

}  // namespace albtpu
