#include "sea/response/height_slope_covariance.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>

#include "sea/response/slope_covariance.h"

namespace albtpu {
namespace {

using Complex = std::complex<double>;

// The second derivatives d_xx, d_xy and d_yy of the square of f, of which a ring has the part that is added: by the
// harmonics of f on the ring and of its derivative by ln s.
Eigen::Array3d RingOfSquare(const Eigen::VectorXcd& f, const Eigen::VectorXcd& slope) {
  // The means over a turn of f^2 and f^2 exp(2 i beta).
  double mean_slope = 2 * f[0].real() * slope[0].real();
  Complex turned = 0, turned_slope = 0;
  for (Eigen::Index l = 0; l + 1 < f.size(); ++l) {
    mean_slope += 4 * (std::conj(f[l + 1]) * slope[l + 1]).real();
    turned += 2.0 * f[l] * std::conj(f[l + 1]);
    turned_slope += 2.0 * (slope[l] * std::conj(f[l + 1]) + f[l] * std::conj(slope[l + 1]));
  }
  const Complex difference = 2.0 * turned + turned_slope;  // d_xx - d_yy + 2 i d_xy
  return {(mean_slope + difference.real()) / 2, difference.imag() / 2, (mean_slope - difference.real()) / 2};
}

}  // namespace

Eigen::Matrix2d HeightSlopeCovariance(const BeamSpectrum& spectrum, const LagProducts& products,
                                      const FootprintKernel& footprint) {
  const auto squares = products.squared_heights.topRows(footprint.overlap().size());
  const Eigen::Array3d on_edge = squares.transpose() * footprint.overlap_edge().matrix();
  const double difference = on_edge[0] - on_edge[2];
  const Eigen::Array3d of_pairs =
      Eigen::Array3d(difference, 2 * on_edge[1], -difference) +
      Eigen::Array3d(squares.transpose() * footprint.overlap_edge_slope().matrix());

  Eigen::Array3d of_points = Eigen::Array3d::Zero();
  const Eigen::Index harmonics = spectrum.slope.cols();
  for (const SpectrumRing& ring : footprint.irradiance_rings()) {
    const auto at = [&](const Eigen::MatrixXd& kernel) {
      return Eigen::VectorXcd(
          kernel.leftCols(harmonics).cwiseProduct(spectrum.slope).colwise().sum().transpose());
    };
    of_points += ring.weight * RingOfSquare(at(ring.value), at(ring.slope));
  }

  const double cosine = std::cos(spectrum.incidence);
  const Eigen::Array3d sum = (of_points - 0.5 * of_pairs) * Eigen::Array3d(cosine * cosine, cosine, 1);
  const Eigen::Matrix2d covariance =
      (Eigen::Matrix2d() << sum[0], sum[1], sum[1], sum[2]).finished() -
      HeightDifference(spectrum, footprint) * FootprintSlopes(spectrum, footprint);
  // Under long waves the three means cancel to within the errors of their quadrature.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).asDiagonal() *
         solver.eigenvectors().transpose();
}

}  // namespace albtpu
