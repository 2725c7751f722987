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

double HeightDifference(const BeamSpectrum& spectrum, const FootprintKernel& footprint) {
  const auto squares = HankelLattice::Shared().wavenumbers().square();
  return (spectrum.slope.col(0).real().array() / squares * (1 - footprint.average().square())).sum();
}

Eigen::Matrix3d SlopePairs(const LagProducts& products, double incidence, const FootprintKernel& footprint) {
  const Eigen::Index lags = footprint.overlap().size();
  const Eigen::VectorXd sums = products.slope_pairs.topRows(lags).transpose() * footprint.overlap().matrix();
  Eigen::Matrix3d pairs;
  pairs << sums[0], sums[1], sums[2],  //
      sums[1], sums[3], sums[4],       //
      sums[2], sums[4], sums[5];
  // A slope along the azimuth is cos(incidence) times that across the beam.
  const double cosine = std::cos(incidence);
  const Eigen::Vector3d scale(cosine * cosine, cosine, 1);
  return scale.asDiagonal() * pairs * scale.asDiagonal();
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

}  // namespace albtpu
