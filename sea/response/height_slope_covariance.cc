#include "sea/response/height_slope_covariance.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>

namespace albtpu {
namespace {

using Complex = std::complex<double>;

// d_xx + d_yy and d_xx - d_yy + 2 i d_xy.
struct Derivatives {
  double trace = 0;
  Complex difference = 0;
};

// Adds the part of a ring to the integrals of p and the derivatives of f^2, by the harmonics of f on the ring and of
// its derivative by ln s.
void AddRing(double weight, const Eigen::VectorXcd& f, const Eigen::VectorXcd& slope, Derivatives& sum) {
  // The means over a turn of f^2 and f^2 exp(2 i beta).
  double mean_slope = 2 * f[0].real() * slope[0].real();
  Complex turned = 0, turned_slope = 0;
  for (Eigen::Index l = 0; l + 1 < f.size(); ++l) {
    mean_slope += 4 * (std::conj(f[l + 1]) * slope[l + 1]).real();
    turned += 2.0 * f[l] * std::conj(f[l + 1]);
    turned_slope += 2.0 * (slope[l] * std::conj(f[l + 1]) + f[l] * std::conj(slope[l + 1]));
  }
  sum.trace += weight * mean_slope;
  sum.difference += weight * (2.0 * turned + turned_slope);
}

}  // namespace

Eigen::Matrix2d HeightSlopeCovariance(const BeamSpectrum& spectrum, const LagCovariances& lags,
                                      const FootprintKernel& footprint) {
  const HankelLattice& lattice = HankelLattice::Shared();
  Derivatives of_pairs, of_points;
  for (const LagRing& ring : footprint.overlap_rings()) {
    const auto about = lags.height.middleRows(ring.first, LagRing::kLags);
    AddRing(ring.weight, about.transpose() * ring.value, about.transpose() * ring.slope, of_pairs);
  }
  const Eigen::Index harmonics = spectrum.slope.cols();
  for (const SpectrumRing& ring : footprint.irradiance_rings()) {
    const auto at = [&](const Eigen::MatrixXd& kernel) {
      return Eigen::VectorXcd(
          kernel.leftCols(harmonics).cwiseProduct(spectrum.slope).colwise().sum().transpose());
    };
    AddRing(ring.weight, at(ring.value), at(ring.slope), of_points);
  }

  const Eigen::ArrayXd elevation = spectrum.slope.col(0).real().array() / lattice.wavenumbers().square();
  const double mean_difference = (elevation * (1 - footprint.average().square())).sum();  // D"
  const Eigen::VectorXcd slopes =
      spectrum.slope.leftCols(2).transpose() * footprint.average().square().matrix();
  const double trace = -0.5 * of_pairs.trace + of_points.trace - mean_difference * slopes[0].real();
  const Complex difference =
      -0.5 * of_pairs.difference + of_points.difference - mean_difference * std::conj(slopes[1]);
  const double cosine = std::cos(spectrum.incidence);
  const double along = 0.5 * (trace + difference.real()) * cosine * cosine;
  const double across = 0.5 * (trace - difference.real()), both = 0.5 * difference.imag() * cosine;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(
      (Eigen::Matrix2d() << along, both, both, across).finished());
  // Under long waves the three means cancel to within the errors of their quadrature.
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).asDiagonal() *
         solver.eigenvectors().transpose();
}

}  // namespace albtpu
