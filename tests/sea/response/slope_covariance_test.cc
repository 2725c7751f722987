#include "sea/response/slope_covariance.h"

#include <gtest/gtest.h>

#include "sea/sea_state.h"
#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

const BeamProfile kProfiles[] = {BeamProfile::kUniform, BeamProfile::kGaussian};

// The covariance in x and y turned along and across the azimuth.
Eigen::Matrix2d AlongAzimuth(const Eigen::Matrix2d& covariance, double azimuth) {
  const double c = std::cos(azimuth), s = std::sin(azimuth);
  const Eigen::Matrix2d axes = (Eigen::Matrix2d() << c, -s, s, c).finished();
  return axes.transpose() * covariance * axes;
}

// The slow twin is sea_state.h, which sums the waves in five times finer steps and in 32 directions.
TEST(FootprintSlopes, AreTheIntegralOverAllWaves) {
  for (const BeamProfile profile : kProfiles) {
    for (const double footprint : {0.1, 0.6, 4.0}) {
      const BeamOptions beam{.incidence = 0.5, .azimuth = 0.8, .footprint = footprint, .profile = profile};
      const SeaState sea(SeaOptions{.waves = WindSea{.wind_speed_10m = 7, .model = &kElfouhailyModel}});
      const Eigen::Matrix2d exact = AlongAzimuth(
          SlopeCovariance(sea, [&](double k, double psi) { return FootprintPower(beam, k, psi); }), beam.azimuth);
      const Eigen::Matrix2d ours = FootprintSlopes(SlopeSpectrum(WindSeaOf(7)).AcrossBeam(beam.incidence, beam.azimuth),
                                                   FootprintKernel(profile, footprint));
      EXPECT_LT((ours - exact).norm(), 1e-3 * exact.norm()) << Name(profile) << footprint;
    }
  }
}

TEST(FootprintSlopes, AreTheIntegralOverCrossingWaves) {
  const BeamOptions beam{.incidence = 0.4, .azimuth = 2.5, .footprint = 1.5};
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  ForEachWave(CrossingSea(), 64, [&](double variance, const Eigen::Vector2d& k) {
    sum += variance * FootprintPower(beam, k.norm(), std::atan2(k.y(), k.x())) * k * k.transpose();
  });
  const Eigen::Matrix2d ours =
      FootprintSlopes(SlopeSpectrum(CrossingSea()).AcrossBeam(0.4, 2.5), FootprintKernel(BeamProfile::kUniform, 1.5));
  EXPECT_LT((ours - AlongAzimuth(sum, 2.5)).norm(), 5e-4 * sum.norm());
}

// The slow twin: pairs of points on the ellipse on the water, R by the sum of the waves of a narrow sea.
TEST(SlopePairs, AreMeansOverPairsOfPointsOfTheFootprint) {
  constexpr double kIncidence = 0.5, kAzimuth = 0.8, kDiameter = 1.2;
  const HarmonicSpectrum sea = Swell(2e-4, 4, 0.3, 0.6, 0.3);
  std::vector<std::pair<double, Eigen::Vector2d>> waves;  // along and across the azimuth
  ForEachWave(sea, 24, [&](double variance, const Eigen::Vector2d& k) {
    if (variance < 1e-10) return;
    waves.emplace_back(variance, Eigen::Vector2d(k.x() * std::cos(kAzimuth) + k.y() * std::sin(kAzimuth),
                                                 k.y() * std::cos(kAzimuth) - k.x() * std::sin(kAzimuth)));
  });
  // The lag of two points has the density of the overlap.
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double weights = 0;
  constexpr int kSteps = 24, kDirections = 24;
  for (int i = 0; i < kSteps; ++i) {
    const double s = (i + 0.5) / kSteps;
    const double weight = s * FootprintOverlap(BeamProfile::kUniform, s);
    for (int j = 0; j < kDirections; ++j) {
      const double beta = std::numbers::pi * (j + 0.5) / kDirections;
      const Eigen::Vector2d lag =
          kDiameter * s * Eigen::Vector2d(std::cos(beta) / std::cos(kIncidence), std::sin(beta));
      Eigen::Vector3d r = Eigen::Vector3d::Zero();
      for (const auto& [variance, k] : waves)
        r += variance * std::cos(k.dot(lag)) * Eigen::Vector3d(k.x() * k.x(), k.x() * k.y(), k.y() * k.y());
      sum += weight * r * r.transpose();
      weights += weight;
    }
  }
  sum /= weights;
  const BeamSpectrum spectrum = SlopeSpectrum(sea).AcrossBeam(kIncidence, kAzimuth);
  const FootprintKernel footprint(BeamProfile::kUniform, kDiameter);
  const Eigen::Matrix3d ours = SlopePairs(
      LagProducts(LagCovariances(spectrum, static_cast<int>(footprint.overlap().size()))), kIncidence, footprint);
  EXPECT_LT((ours - sum).norm(), 0.005 * sum.norm()) << ours << "\n\n" << sum;
}

// In a footprint that is small beside the waves all its points have one slope.
TEST(SlopePairs, OfOneSlopeAreProductsOfItsCovariance) {
  const SlopeSpectrum sea(Swell(0.02, 0.5, 1.0, 0.7, 0.3));
  const FootprintKernel footprint(BeamProfile::kUniform, 0.05);
  const LagCovariances lags(sea.AcrossBeam(0.4, 0), static_cast<int>(footprint.overlap().size()));
  const Eigen::Matrix3d pairs = SlopePairs(LagProducts(lags), 0.4, footprint);
  const Eigen::Matrix2d r = sea.Covariance();
  const Eigen::Vector3d elements(r(0, 0), r(0, 1), r(1, 1));
  EXPECT_LT((pairs - elements * elements.transpose()).norm(), 2e-3 * pairs.norm());

  const Eigen::Matrix2d g = (Eigen::Matrix2d() << 1, 0.3, 0.3, 2).finished(),
                        h = (Eigen::Matrix2d() << 0.5, -0.2, -0.2, 1).finished();
  EXPECT_NEAR(MeanOfForms(g, h, elements * elements.transpose()), (g * r * h * r).trace(), 1e-15);
}

}  // namespace
}  // namespace albtpu
