// A round footprint as weights on the wavenumbers and lags of HankelLattice.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sea/quadrature/hankel_lattice.h"
#include "sea/response/closed_form.h"

namespace albtpu {

// A weight p that falls with the distance s, such as the irradiance of a footprint, is a mixture of even discs. By
// partial integration, with <> the mean over the directions beta of a circle of the radius s, and n = (cos beta,
// sin beta),
//     integral of p d_a f      = sum of weight * <s f n_a>,
//     integral of p d_a d_b f  = sum of weight * (<f (2 n_a n_b - delta_ab)> + d <f n_a n_b> / d ln s)
// over the edges of the discs, the weight being 2 pi |dp|.

// Such an edge. The column l takes the harmonic l of a BeamSpectrum to that of D' on the edge, and to its derivative by
// ln s, where D' is the height difference of LagCovariances averaged over the footprint at one of its two points.
struct SpectrumRing {
  Eigen::MatrixXd value, slope;
  double weight;
};

// Immutable; one serves all seas and directions.
class FootprintKernel {
 public:
  // The spacing of the lags of LagCovariances, in steps of the lattice.
  static constexpr int kLagStride = 2;

  // `diameter` [m] across the beam.
  FootprintKernel(BeamProfile profile, double diameter);

  // W, the factor by which the footprint reduces a wave, at the wavenumbers across the beam.
  const Eigen::ArrayXd& average() const { return average_; }

  // The autocorrelation a of the footprint, whose integral over the plane is 1: the means over two points of a
  // footprint are integrals of a over their lag. Its integral over the rings about the lags 0, kLagStride, ..., so that
  // overlap()[j] times a function at the lag j, averaged over directions, sums up to the integral.
  const Eigen::ArrayXd& overlap() const { return overlap_; }

  // The sums over the edges of the discs whose mixture is a: that of overlap_edge()[j] times a function at the lag j
  // is the sum of weight times the function, that of overlap_edge_slope()[j] times it the sum of weight times its
  // derivative by ln s. Functions are interpolated by polynomials through six lags.
  const Eigen::ArrayXd& overlap_edge() const { return overlap_edge_; }
  const Eigen::ArrayXd& overlap_edge_slope() const { return overlap_edge_slope_; }

  // The edges of the discs whose mixture is the irradiance, whose integral over the plane is 1.
  const std::vector<SpectrumRing>& irradiance_rings() const { return irradiance_rings_; }

 private:
  Eigen::ArrayXd average_, overlap_, overlap_edge_, overlap_edge_slope_;
  std::vector<SpectrumRing> irradiance_rings_;
};

}  // namespace albtpu
