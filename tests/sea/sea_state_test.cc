#include "sea/sea_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sea/response/closed_form.h"

namespace albtpu {
namespace {

constexpr double kFullyDeveloped = std::numeric_limits<double>::infinity();

// The slow twin of SlopeCovariance: five times as many wavenumbers and four times as many directions.
Eigen::Matrix2d FineSlopeCovariance(const SeaState& sea, const BeamOptions& beam) {
  constexpr double kStep = 0.004;
  constexpr int kDirections = 128;
  const auto [lowest, highest] = sea.energetic_range();
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (double k = lowest; k < highest; k *= std::exp(kStep)) {
    for (int j = 0; j < kDirections; ++j) {
      const double psi = 2 * std::numbers::pi * (j + 0.5) / kDirections;
      const Eigen::Vector2d wave(k * std::cos(psi), k * std::sin(psi));
      sum += sea.Psi(k, psi) * FootprintPower(beam, k, psi) * k * k * kStep * (2 * std::numbers::pi / kDirections) *
             wave * wave.transpose();
    }
  }
  return sum;
}

TEST(SeaState, IsSymmetricUnderAHalfTurnAndAboutTheWind) {
  const SeaState sea(7, 1e4);
  for (const double psi : {0.1, 0.8, 1.5}) {
    EXPECT_NEAR(sea.Psi(3, psi) / sea.Psi(3, psi + std::numbers::pi), 1, 1e-12);
    EXPECT_NEAR(sea.Psi(3, psi) / sea.Psi(3, -psi), 1, 1e-12);
  }
}

TEST(SeaState, HasSlopeVariancesInTheRatioSevenToFive) {
  const Eigen::Matrix2d slopes = SlopeCovariance(SeaState(5, kFullyDeveloped));
  EXPECT_NEAR(slopes.trace(), 0.049, 0.0005);  // printed precision
  EXPECT_NEAR(slopes(0, 0) / slopes(1, 1), 7.0 / 5, 1e-9);
  EXPECT_NEAR(slopes(0, 1), 0, 1e-12);
}

TEST(SeaState, HasTheWaveHeightOfItsSpectrum) {
  EXPECT_NEAR(4 * std::sqrt(ElevationVariance(SeaState(10, kFullyDeveloped))), 2.04, 0.005);
}

TEST(SeaState, OfElfouhailySpreadsWavesByTheirWavenumber) {
  const SeaState sea({.waves = WindSea{.wind_speed_10m = 7, .model = &kElfouhailyModel}});
  // Along and across, from the Python script of elfouhaily_spectrum_test.cc.
  const Eigen::Matrix2d slopes = SlopeCovariance(sea);
  EXPECT_NEAR(slopes(0, 0), 0.02375, 5e-6);
  EXPECT_NEAR(slopes(1, 1), 0.01637, 5e-6);
  const double k_p = sea.spectrum().peak_wavenumber();
  EXPECT_LT(sea.Psi(k_p, std::numbers::pi / 2) / sea.Psi(k_p, 0), 1e-3);
  EXPECT_GT(sea.Psi(30, std::numbers::pi / 2) / sea.Psi(30, 0), 0.6);
}

TEST(SeaState, LosesTheVarianceOfTheCorrectedWaves) {
  for (const SpectrumModel* model : kSpectrumModels) {
    const SeaOptions options{.waves = WindSea{.wind_speed_10m = 8, .model = model}};
    SeaOptions corrected = options;
    corrected.corrected_above = 20;
    const SeaState whole(options), rest(corrected);
    const double longest = 2 * std::numbers::pi / 20;
    const double removed = ElevationVariance(whole) - ElevationVariance(rest);
    // Simpson's rule over the waves left out.
    constexpr int kSteps = 2000;
    const double lowest = whole.energetic_range().lowest, step = (longest - lowest) / kSteps;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i)
      sum += whole.S(lowest + i * step) * step / 3 * (i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2);
    EXPECT_NEAR(removed / sum, 1, 1e-3) << model->key;
    EXPECT_EQ(rest.S(0.99 * longest), 0) << model->key;
    EXPECT_EQ(rest.S(1.01 * longest), whole.S(1.01 * longest)) << model->key;
  }
}

TEST(SeaState, IsUnchangedByALimitAboveItsLongestWave) {
  const SeaState sea(8, 1e4);
  SeaOptions options = sea.options();
  options.corrected_above = 1e6;  // m, longer than any wave
  const SeaState same(options);
  EXPECT_EQ(ElevationVariance(sea), ElevationVariance(same));
  EXPECT_EQ(SlopeCovariance(sea), SlopeCovariance(same));
}

TEST(SeaState, ScalesTheHeightOfEveryWave) {
  const SeaState sea(8, 1e4), scaled({.waves = WindSea{.wind_speed_10m = 8, .fetch = 1e4}, .height_scale = 3});
  EXPECT_NEAR(ElevationVariance(scaled) / ElevationVariance(sea), 9, 1e-12);
  EXPECT_NEAR(scaled.Psi(3, 0.4) / sea.Psi(3, 0.4), 9, 1e-12);
}

TEST(SlopeCovariance, IsAccurateToOnePartInTenThousandForAnyFootprint) {
  for (const double wind_speed : {2.0, 12.0}) {
    for (const double fetch : {100.0, kFullyDeveloped}) {
      for (const double footprint : {0.1, 0.5, 5.0}) {
        for (const SpectrumModel* model : kSpectrumModels) {
          const SeaState sea({.waves = WindSea{.wind_speed_10m = wind_speed, .fetch = fetch, .model = model}});
          const BeamOptions beam{.incidence = 0.4, .azimuth = 0.5, .footprint = footprint};
          const Eigen::Matrix2d fast =
              SlopeCovariance(sea, [&](double k, double psi) { return FootprintPower(beam, k, psi); });
          const Eigen::Matrix2d fine = FineSlopeCovariance(sea, beam);
          const double passed = std::max(fine.norm(), 3e-5 * SlopeCovariance(sea).trace());
          EXPECT_LT((fast - fine).norm(), 1e-4 * passed)
              << model->key << ", " << wind_speed << " m/s, " << fetch << " m, footprint " << footprint;
        }
      }
    }
  }
}

}  // namespace
}  // namespace albtpu
