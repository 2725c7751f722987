#include "sea/response/footprint_shift.h"

#include <cmath>

namespace albtpu {
namespace {

// d_x d_x of the covariance of the slopes averaged over the footprint: across the beam, in the order of LagProducts.
Eigen::Array3d SecondDerivatives(const BeamSpectrum& spectrum, const FootprintKernel& footprint) {
  const Eigen::ArrayXd weights = footprint.average().square() * HankelLattice::Shared().wavenumbers().square();
  const Eigen::Array3cd e = spectrum.slope.leftCols(3).transpose() * weights.matrix();
  // The means of cos^4, cos^3 sin and cos^2 sin^2 of psi.
  return -Eigen::Array3d(3.0 / 8 * e[0].real() + e[1].real() / 2 + e[2].real() / 8, -e[1].imag() / 4 - e[2].imag() / 8,
                         (e[0].real() - e[2].real()) / 8);
}

Eigen::Matrix2d Symmetric(const Eigen::Array3d& elements) {
  return (Eigen::Matrix2d() << elements[0], elements[1], elements[1], elements[2]).finished();
}

}  // namespace

FootprintShift FootprintShiftOf(const BeamSpectrum& spectrum, const LagProducts& products, const Eigen::Matrix3d& pairs,
                                const FootprintKernel& footprint) {
  const Eigen::Index lags = footprint.overlap().size();
  const auto on_edge = [&](const Eigen::MatrixXd& values) {
    return Eigen::ArrayXd(values.topRows(lags).transpose() * footprint.overlap_edge().matrix());
  };
  const auto slope_on_edge = [&](const Eigen::MatrixXd& values) {
    return Eigen::ArrayXd(values.topRows(lags).transpose() * footprint.overlap_edge_slope().matrix());
  };
  // The integral of a d_x d_x f, by the means of f and of f cos(2 beta).
  const auto second = [&](const Eigen::MatrixXd& mean, const Eigen::MatrixXd& turned) {
    return Eigen::Array3d(on_edge(turned) + slope_on_edge(mean + turned) / 2);
  };

  // On the water a derivative along the azimuth is cos(incidence) times that across the beam.
  const double cosine = std::cos(spectrum.incidence);
  const Eigen::Array3d scale(cosine * cosine, cosine, 1);
  const Eigen::ArrayXd gradients = on_edge(products.gradient_slopes) * cosine;
  const Eigen::Array3d along = cosine * scale * gradients.head<3>(), across = scale * gradients.tail<3>();
  const double mean = HeightDifference(spectrum, footprint);
  const Eigen::Array3d spread =
      second(products.height_slopes, products.turned_height_slopes) -
      mean * (second(products.slopes, products.turned_slopes) - SecondDerivatives(spectrum, footprint));

  FootprintShift shift;
  shift.drift = {Symmetric(along - pairs.col(0).array()), Symmetric(across - pairs.col(1).array())};
  shift.spread = Symmetric(cosine * cosine * scale * spread - 2 * along + pairs.col(0).array());
  return shift;
}

}  // namespace albtpu
