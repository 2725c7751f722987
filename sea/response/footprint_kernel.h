// A round footprint as weights on the wavenumbers and lags of HankelLattice.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sea/quadrature/hankel_lattice.h"
#include "sea/response/footprint.h"

namespace albtpu {

// A weight p that falls with the distance s, such as the irradiance of a footprint, is a mixture of even discs. By
// partial integration, with f_0 and f_1 the means of f and f exp(2 i beta) over the circle of the radius s,
//     integral of p (d_xx + d_yy) f             = sum of weight * d f_0 / d ln s,
//     integral of p (d_xx - d_yy + 2 i d_xy) f  = sum of weight * (2 f_1 + d f_1 / d ln s)
// over the edges of the discs, the weight being 2 pi |dp|. Each of the next two is such an edge.

// Weights that take a function at six lags about the edge to its value there, and to its derivative by ln s (Lagrange's
// polynomial).
struct LagRing {
  static constexpr int kLags = 6;

  int first;  // lag
  Eigen::Matrix<double, kLags, 1> value, slope;
  double weight;
};

// The column l takes the harmonic l of a BeamSpectrum to that of D' on the edge, and to its derivative by ln s, where
// D' is the height difference of LagCovariances averaged over the footprint at one of its two points.
struct SpectrumRing {
  Eigen::MatrixXd value, slope;
  double weight;
};

// Immutable; one serves all seas and directions.
class FootprintKernel {
 public:
  // Lags of LagCovariances are so many steps of the lattice apart.
  static constexpr int kLagStride = 2;

  // `diameter` [m] across the beam.
  FootprintKernel(BeamProfile profile, double diameter);

  // W, the factor by which the footprint reduces a wave, at the wavenumbers across the beam.
  const Eigen::ArrayXd& average() const { return average_; }

  // The autocorrelation a of the footprint, whose integral over the plane is 1: the means over two points of a
  // footprint are integrals of a over their lag. Its integral over the rings about the lags 0, kLagStride, ..., so that
  // overlap()[j] times a function at the lag j, averaged over directions, sums up to the integral.
  const Eigen::ArrayXd& overlap() const { return overlap_; }

  // The edges of the discs whose mixture is a, among the lags of overlap(), and of those whose mixture is the
  // irradiance, whose integral over the plane is 1.
  const std::vector<LagRing>& overlap_rings() const { return overlap_rings_; }
  const std::vector<SpectrumRing>& irradiance_rings() const { return irradiance_rings_; }

 private:
  SpectrumRing OnSpectrum(const LagRing& ring) const;

  Eigen::ArrayXd average_, overlap_;
  std::vector<LagRing> overlap_rings_;
  std::vector<SpectrumRing> irradiance_rings_;
};

}  // namespace albtpu
