#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sea/response/footprint_kernel.h"
#include "sea/response/slope_covariance.h"
#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

// The slow twin: cosines of the waves of a fine grid, on lags in all directions. The sea has no waves so short that the
// grid would alias them at these lags.
TEST(LagCovariances, AreSumsOfCosines) {
  const HarmonicSpectrum sea = WeightedSum(Swell(2e-4, 6, 1.0, 0.6, 0.3), 1, Swell(1e-4, 2, -0.3, 0.8, 0.5), 1);
  constexpr int kLags = 75;
  const LagCovariances covariances(SlopeSpectrum(sea).AcrossBeam(0, 0), kLags);
  for (const int j : {0, 20, 50, 62, 70}) {
    const double lag = HankelLattice::Shared().Lag(j * FootprintKernel::kLagStride);
    for (const Eigen::Index d : {0, 2, 5}) {
      const Eigen::Vector2d n(std::cos(covariances.directions[d]), std::sin(covariances.directions[d]));
      Eigen::Matrix2d slopes = Eigen::Matrix2d::Zero();
      Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
      double height = 0, variance = 0;
      ForEachWave(sea, 128, [&](double power, const Eigen::Vector2d& k) {
        const double phase = lag * k.dot(n);
        slopes += power * std::cos(phase) * k * k.transpose();
        gradient += lag * power * std::sin(phase) * k;
        height += power * (1 - std::cos(phase));
        variance += power * k.squaredNorm();
      });
      // Waves between the samples: 5 % steps alter the cosines by (0.05 k lag)^2 / 12, the harmonics end at the sixth.
      const double allowed = 0.005 * variance;
      EXPECT_NEAR(covariances.along(j, d), slopes(0, 0), allowed) << lag << " m, " << d;
      EXPECT_NEAR(covariances.both(j, d), slopes(0, 1), allowed) << lag << " m, " << d;
      EXPECT_NEAR(covariances.across(j, d), slopes(1, 1), allowed) << lag << " m, " << d;
      EXPECT_NEAR(covariances.height(j, d) / height, 1, 0.005) << lag << " m, " << d;
      EXPECT_NEAR(covariances.height_along(j, d), gradient.x(), 0.01 * height) << lag << " m, " << d;
      EXPECT_NEAR(covariances.height_across(j, d), gradient.y(), 0.01 * height) << lag << " m, " << d;
    }
  }
}

// The means over 64 directions of the trigonometric polynomials through the values.
TEST(LagProducts, AreMeansOverAllDirections) {
  const LagCovariances r(SlopeSpectrum(CrossingSea()).AcrossBeam(0.4, 0.9), 60);
  const LagProducts products(r);
  constexpr int kLag = 45, kDirections = 64;
  const auto count = static_cast<int>(r.directions.size());
  // Of even harmonics, 2 l, or of odd ones, 2 l + 1.
  const auto at = [&](const Eigen::ArrayXXd& values, double beta, bool odd) {
    double sum = 0;
    for (int d = 0; d < count; ++d) {
      double kernel = 0;
      for (int l = -(count - 1) / 2; l <= (count - 1) / 2; ++l)
        kernel += std::cos((2 * l + (odd ? 1 : 0)) * (beta - r.directions[d]));
      sum += kernel / count * values(kLag, d);
    }
    return sum;
  };
  double pair = 0, squared = 0, turned = 0, gradient = 0;
  for (int d = 0; d < kDirections; ++d) {
    const double beta = 2 * std::numbers::pi * (d + 0.3) / kDirections;
    const double along = at(r.along, beta, false), both = at(r.both, beta, false);
    const double height = at(r.height, beta, false);
    pair += along * both / kDirections;
    squared += height * height * std::cos(beta) * std::sin(beta) / kDirections;
    turned += height * both * std::cos(2 * beta) / kDirections;
    gradient += at(r.height_across, beta, true) * along * std::cos(beta) / kDirections;
  }
  const double slope = r.along.abs().maxCoeff(), height = r.height.row(kLag).maxCoeff();
  EXPECT_NEAR(products.slope_pairs(kLag, 1), pair, 1e-10 * slope * slope);
  EXPECT_NEAR(products.squared_heights(kLag, 1), squared, 1e-10 * height * height);
  EXPECT_NEAR(products.turned_height_slopes(kLag, 1), turned, 1e-10 * height * slope);
  EXPECT_NEAR(products.gradient_slopes(kLag, 3), gradient, 1e-10 * height * slope);
}

}  // namespace
}  // namespace albtpu
