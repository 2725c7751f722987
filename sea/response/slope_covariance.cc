#include "sea/response/slope_covariance.h"

#include <cmath>

namespace albtpu {
namespace {

// Of R_ab in the order of SlopePairs.
int Element(int a, int b) { return a + b; }

}  // namespace

Eigen::Matrix2d FootprintSlopes(const BeamSpectrum& spectrum, const FootprintKernel& footprint) {
  const Eigen::VectorXcd sums =
      spectrum.slope.leftCols(2).transpose() * footprint.average().square().matrix();
  const double cosine = std::cos(spectrum.incidence);
  const double along = 0.5 * (sums[0] + sums[1]).real() * cosine * cosine;
  const double across = 0.5 * (sums[0] - sums[1]).real(), both = -0.5 * sums[1].imag() * cosine;
  return (Eigen::Matrix2d() << along, both, both, across).finished();
}

Eigen::Matrix3d SlopePairs(const LagProducts& products, double incidence, const FootprintKernel& footprint) {
  const Eigen::Matrix<double, 6, 1> sums =
      products.topRows(footprint.overlap().size()).transpose() * footprint.overlap().matrix();
  const double tt = sums[0], tx = sums[2], ty = sums[3];
  const double xx = (sums[1] + sums[4]) / 2, yy = (sums[1] - sums[4]) / 2, xy = sums[5] / 2;
  // R_11 = (T + Re Z) / 2, R_12 = Im Z / 2, R_22 = (T - Re Z) / 2.
  Eigen::Matrix3d pairs;
  pairs << tt + 2 * tx + xx, ty + xy, tt - xx,  //
      ty + xy, yy, ty - xy,                     //
      tt - xx, ty - xy, tt - 2 * tx + xx;
  // A slope along the azimuth is cos(incidence) times that across the beam.
  const double cosine = std::cos(incidence);
  const Eigen::Vector3d scale(cosine * cosine, cosine, 1);
  return scale.asDiagonal() * (pairs / 4) * scale.asDiagonal();
}

double MeanOfForms(const Eigen::Matrix2d& g, const Eigen::Matrix2d& h, const Eigen::Matrix3d& pairs) {
  double sum = 0;
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      for (int c = 0; c < 2; ++c) {
        for (int d = 0; d < 2; ++d) sum += g(a, b) * h(c, d) * pairs(Element(b, c), Element(d, a));
      }
    }
  }
  return sum;
}

Eigen::Matrix2d MeanOfSquares(double squared_tau, const Eigen::Matrix3d& pairs) {
  return squared_tau * pairs.topLeftCorner<2, 2>();
}

}  // namespace albtpu
