#include "sea/response/lag_covariances.h"

#include <gtest/gtest.h>

#include <complex>

#include "sea/response/footprint_kernel.h"
#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

using Complex = std::complex<double>;

// The slow twin: cosines of the waves of a fine grid, on lags in all directions. The sea has no waves so short that the
// grid would alias them at these lags.
TEST(LagCovariances, AreSumsOfCosines) {
  const HarmonicSpectrum sea =
      WeightedSum(Swell(2e-4, 6, 1.0, 0.6, 0.3), 1, Swell(1e-4, 2, -0.3, 0.8, 0.5), 1);
  constexpr int kLags = 75;
  const LagCovariances covariances(SlopeSpectrum(sea).AcrossBeam(0, 0), kLags);
  for (const int j : {0, 20, 50, 62, 70}) {
    const double lag = HankelLattice::Shared().Lag(j * FootprintKernel::kLagStride);
    for (const double beta : {0.0, 0.5, 2.0}) {
      double xx = 0, yy = 0, xy = 0, height = 0, variance = 0;
      ForEachWave(sea, 128, [&](double power, const Eigen::Vector2d& k) {
        const double cosine = std::cos(lag * (k.x() * std::cos(beta) + k.y() * std::sin(beta)));
        xx += power * k.x() * k.x() * cosine;
        yy += power * k.y() * k.y() * cosine;
        xy += power * k.x() * k.y() * cosine;
        height += power * (1 - cosine);
        variance += power * k.squaredNorm();
      });
      Complex trace = 0, difference = 0, difference_height = 0;
      for (Eigen::Index l = 0; l < covariances.trace.cols(); ++l) {
        const Complex turn = std::polar(1.0, 2.0 * l * beta);
        const double both = l == 0 ? 1 : 2;
        trace += both * (covariances.trace(j, l) * turn).real();
        difference_height += both * (covariances.height(j, l) * turn).real();
        difference += covariances.difference(j, l) * turn;
        if (l > 0) difference += covariances.difference_of_negative(j, l) * std::conj(turn);
      }
      // Waves between the samples: 5 % steps alter the cosines by (0.05 k lag)^2 / 12, the harmonics end at the sixth.
      const double allowed = 0.005 * variance;
      EXPECT_NEAR(trace.real(), xx + yy, allowed) << lag << " m, " << beta;
      EXPECT_NEAR(difference.real(), xx - yy, allowed) << lag << " m, " << beta;
      EXPECT_NEAR(difference.imag(), 2 * xy, allowed) << lag << " m, " << beta;
      EXPECT_NEAR(difference_height.real() / height, 1, 0.005) << lag << " m, " << beta;
    }
  }
}

// The means of the products over 64 directions of the same harmonics.
TEST(LagProducts, AreMeansOverAllDirections) {
  const LagCovariances r(SlopeSpectrum(CrossingSea()).AcrossBeam(0.4, 0.9), 60);
  const LagProducts products = ProductsOf(r);
  constexpr int kDirections = 64, kLag = 45;
  Eigen::Matrix<double, 6, 1> means = Eigen::Matrix<double, 6, 1>::Zero();
  for (int d = 0; d < kDirections; ++d) {
    const double beta = 2 * std::numbers::pi * d / kDirections;
    double t = 0;
    Complex z = 0;
    for (Eigen::Index l = 0; l < r.trace.cols(); ++l) {
      const Complex turn = std::polar(1.0, 2.0 * l * beta);
      t += (l == 0 ? 1 : 2) * (r.trace(kLag, l) * turn).real();
      z += r.difference(kLag, l) * turn;
      if (l > 0) z += r.difference_of_negative(kLag, l) * std::conj(turn);
    }
    const Eigen::Matrix<double, 6, 1> here = (Eigen::Matrix<double, 6, 1>() << t * t, std::norm(z),
                                              t * z.real(), t * z.imag(), (z * z).real(), (z * z).imag())
                                                 .finished();
    means += here / kDirections;
  }
  EXPECT_LT((products.row(kLag).transpose() - means).norm(), 1e-12 * means.norm());
}

}  // namespace
}  // namespace albtpu
