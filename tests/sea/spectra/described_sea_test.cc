#include "sea/spectra/described_sea.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sea/spectra/binned_spectrum.h"
#include "sea/spectra/elfouhaily_spectrum.h"
#include "sea/spectra/equilibrium_wind.h"
#include "sea/spectra/jonswap.h"
#include "sea/spectra/sea_error.h"
#include "sea/spectra/spectrum_moments.h"
#include "sea/spectra/wind_sea.h"
#include "tests/degree.h"
#include "tests/sea/spectra/deep_water.h"

namespace albtpu {
namespace {

using albtpu::testing::kDegree;

std::shared_ptr<const FrequencySpectrum> Swell(double hs = 1, double towards = 0.5) {
  return std::make_shared<JonswapSpectrum>(std::vector{JonswapWaves{.significant_wave_height = hs,
                                                                    .peak_period = 9,
                                                                    .gamma = 7,
                                                                    .travels_towards = towards,
                                                                    .spread = 18 * kDegree}});
}

// Elfouhaily's fully developed sea, times a factor, in narrow bins up to 0.6 Hz, with its wind from the west.
std::shared_ptr<const FrequencySpectrum> MeasuredWindSea(double wind_speed, double factor) {
  const ElfouhailySpectrum wind(wind_speed, kDeep);
  std::vector<double> centres;
  std::vector<DirectionalEnergy> bins;
  for (double f = 0.03; f < 0.6; f += 0.0002) {
    const double k = WavenumberOfFrequency(f, kDeep);
    centres.push_back(f);
    bins.push_back(SymmetricEnergy(factor * wind(k) / FrequencySlope(k, kDeep), {wind.Delta(k) / 2}, 90 * kDegree));
  }
  return std::make_shared<BinnedSpectrum>(std::make_shared<const std::vector<double>>(std::move(centres)), bins, 1,
                                          0.4);
}

// What a sample at k[i] stands for: the mean of E with weights that fall to its neighbours.
double AroundSample(const WaveSpectrum& spectrum, const std::vector<double>& k, std::size_t i) {
  const auto f = [&](std::size_t of) { return FrequencyOfWavenumber(k[of], kDeep); };
  double sum = 0, weights = 0;
  for (double t = -0.995; t < 1; t += 0.01) {
    const double width = t < 0 ? f(i) - f(i - 1) : f(i + 1) - f(i), weight = (1 - std::abs(t)) * width;
    const double at = WavenumberOfFrequency(f(i) + t * width, kDeep);
    sum += weight * spectrum(at) / FrequencySlope(at, kDeep);
    weights += weight;
  }
  return sum / weights * FrequencySlope(k[i], kDeep);
}

TEST(DescribedSea, IsTheWindSeaItselfWhereThatWasMeasured) {
  const ElfouhailySpectrum wind(8, kDeep);
  const HarmonicSpectrum whole = Sampled(wind, SeaWavenumbers(), 1);
  for (const TailRule rule : {TailRule::kWind, TailRule::kRelax, TailRule::kLevel}) {
    const DescribedSea sea =
        Describe({.waves = MeasuredWindSea(8, 1), .wind_speed_10m = 8, .wind_from = 270 * kDegree, .tail = rule});
    EXPECT_NEAR(sea.q, 1, 1e-12);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      if (whole.k[i] < 0.03) continue;  // so steep that straight lines between bins are too high
      const double s = whole.k[i] < 0.1 ? AroundSample(wind, whole.k, i) : whole.s[i];  // 0.1 rad/m: steep below it
      EXPECT_NEAR(sea.spectrum.s[i], s, 2e-3 * s) << whole.k[i];
      EXPECT_NEAR(sea.spectrum.a[0][i], whole.a[0][i], 1e-3) << whole.k[i];
    }
  }
}

TEST(DescribedSea, TakesTheLevelOfTheWavesOrOfTheWindAboveTheCutoff) {
  const ElfouhailySpectrum wind(8, kDeep);
  const auto ratio = [&](TailRule rule, double k) {
    const DescribedSea sea =
        Describe({.waves = MeasuredWindSea(8, 1.6), .wind_speed_10m = 8, .wind_from = 270 * kDegree, .tail = rule});
    const HarmonicSpectrum at = Resampled(sea.spectrum, {sea.cutoff * k});
    const HarmonicSpectrum of_wind = Resampled(Sampled(wind, SeaWavenumbers(), 1), {sea.cutoff * k});
    return at.s[0] / of_wind.s[0];
  };
  EXPECT_NEAR(ratio(TailRule::kLevel, 30), 1.6, 1e-6);
  EXPECT_NEAR(ratio(TailRule::kWind, 30), 1, 1e-6);
  EXPECT_NEAR(ratio(TailRule::kRelax, 30), 1, 1e-6);
  EXPECT_NEAR(ratio(TailRule::kRelax, std::sqrt(10)), std::sqrt(1.6), 2e-3);
  EXPECT_EQ(ratio(TailRule::kNone, 30), 0);
  for (const TailRule rule : {TailRule::kWind, TailRule::kRelax, TailRule::kLevel, TailRule::kNone})
    EXPECT_NEAR(ratio(rule, 0.3), 1.6, 4e-3);
}

TEST(DescribedSea, IsExactlyFlatInACalmWithoutSwell) {
  const DescribedSea sea = Describe({.wind_speed_10m = 0});
  for (const double s : sea.spectrum.s) EXPECT_EQ(s, 0);
}

TEST(DescribedSea, HasNothingButTheSwellInACalm) {
  const DescribedSea sea = Describe({.waves = Swell(), .wind_speed_10m = 0});
  EXPECT_EQ(sea.spectrum.s, sea.resolved.s);
  EXPECT_NEAR(sea.x_azimuth, 0.5, 1e-15);  // where the swell travels
  const HarmonicSpectrum swell = ByWavenumber(*Swell(), kDeep, 0.5, SeaWavenumbers());
  EXPECT_NEAR(Resampled(sea.spectrum, {0.05}).s[0] / Resampled(swell, {0.05}).s[0], 1, 1e-12);
  EXPECT_EQ(Resampled(sea.spectrum, {1e3}).s[0], 0);
}

TEST(DescribedSea, LooksAlongItsFirstWavesInACalmAndAlongItsShortestWhereTheWindIsUnknown) {
  const auto waves = std::make_shared<JonswapSpectrum>(
      std::vector{JonswapWaves{.significant_wave_height = 1, .peak_period = 9, .travels_towards = 0.5},
                  JonswapWaves{.significant_wave_height = 0.4, .peak_period = 3, .travels_towards = 2}});
  EXPECT_NEAR(Describe({.waves = waves, .wind_speed_10m = 0}).x_azimuth, 0.5, 1e-15);
  EXPECT_NEAR(Describe({.waves = waves, .wind_speed_10m = 6}).x_azimuth, 2, 1e-15);
}

TEST(DescribedSea, IsTheFullyDevelopedWindSeaWhereNoWavesAreKnown) {
  const DescribedSea sea = Describe({.wind_speed_10m = 6, .wind_from = 1});
  EXPECT_EQ(sea.spectrum.s, Sampled(ElfouhailySpectrum(6, kDeep), SeaWavenumbers(), 1).s);
  EXPECT_NEAR(sea.x_azimuth, 1 + std::numbers::pi, 1e-15);
  EXPECT_EQ(MeanSquareSlope(sea.resolved), 0);
}

// The tail is along the wind: along x, although the waves were measured across it.
TEST(DescribedSea, RunsItsTailAlongTheWind) {
  const DescribedSea sea =
      Describe({.waves = MeasuredWindSea(8, 1), .wind_speed_10m = 8, .wind_from = 0, .water_depth = 20});
  const HarmonicSpectrum at = Resampled(sea.spectrum, {sea.cutoff / 5, sea.cutoff * 5});
  EXPECT_LT(at.a[0][0], -0.1);
  EXPECT_GT(at.a[0][1], 0.05);
}

TEST(DescribedSea, TakesTheWindFromTheWavesAndSaysSo) {
  const auto waves = MeasuredWindSea(8, 1);
  const DescribedSea sea = Describe({.waves = waves});
  EXPECT_TRUE(sea.assumed.wind_speed_from_waves);
  EXPECT_TRUE(sea.assumed.wind_direction_from_waves);
  EXPECT_TRUE(sea.assumed.tail_from_of_waves);
  EXPECT_NEAR(FrictionVelocity(sea.wind_speed_10m), *EquilibriumFrictionVelocity(*waves), 1e-12);
  EXPECT_NEAR(sea.x_azimuth, 90 * kDegree, 1e-9);
  const DescribedSea given = Describe({.waves = waves, .wind_speed_10m = 8, .wind_from = 0, .tail_from = 0.3});
  EXPECT_FALSE(given.assumed.wind_speed_from_waves || given.assumed.wind_direction_from_waves ||
               given.assumed.tail_from_of_waves || given.assumed.wind_unknown || given.assumed.level_held);
  EXPECT_EQ(given.tail_from, 0.3);
}

// Isotropic waves do not tell where the wind blows, and so its waves have no direction, either.
TEST(DescribedSea, IsIsotropicWhereNothingHasADirection) {
  const auto centres = std::make_shared<const std::vector<double>>(std::vector{0.1, 0.2, 0.3, 0.4});
  const std::vector<DirectionalEnergy> bins(4, {.energy = 0.1});
  const auto waves = std::make_shared<BinnedSpectrum>(centres, bins, 1, 0.4);
  const DescribedSea sea = Describe({.waves = waves, .wind_speed_10m = 6});
  EXPECT_TRUE(sea.assumed.wind_direction_unknown);
  EXPECT_FALSE(sea.assumed.wind_direction_from_waves);
  for (const std::vector<double>& harmonic : sea.spectrum.a)
    EXPECT_EQ(std::ranges::count(harmonic, 0), harmonic.size());
  const DescribedSea given = Describe({.waves = waves, .wind_speed_10m = 6, .wind_from = 0});
  EXPECT_FALSE(given.assumed.wind_direction_unknown);
  EXPECT_NEAR(MeanSquareSlope(given.spectrum), MeanSquareSlope(sea.spectrum), 1e-12);
  EXPECT_GT(Resampled(given.spectrum, {50}).a[0][0], 0.05);
}

TEST(DescribedSea, SaysWhereSwellAloneLeavesOutTheSeaOfTheWind) {
  const auto missing = [](std::vector<JonswapWaves> waves) {
    return Describe({.waves = std::make_shared<JonswapSpectrum>(waves), .wind_speed_10m = 8, .wind_from = 0})
        .assumed.wind_sea_missing;
  };
  const JonswapWaves swell{.significant_wave_height = 1, .peak_period = 12},
      own{.significant_wave_height = 1.3, .peak_period = 5};
  EXPECT_TRUE(missing({swell}));
  EXPECT_FALSE(missing({own}));
  EXPECT_FALSE(missing({swell, own}));
  EXPECT_FALSE(Describe({.waves = MeasuredWindSea(8, 0.3), .wind_speed_10m = 8}).assumed.wind_sea_missing);
}

// A spread of sqrt(2) is that of no direction.
TEST(DescribedSea, HasIsotropicWavesOfTheWindWhereItsOwnHaveNoDirection) {
  const JonswapWaves waves{.significant_wave_height = 1, .peak_period = 5, .spread = std::numbers::sqrt2};
  const DescribedSea sea =
      Describe({.waves = std::make_shared<JonswapSpectrum>(std::vector{waves}), .wind_speed_10m = 8});
  EXPECT_TRUE(sea.assumed.wind_direction_unknown);
  for (const std::vector<double>& harmonic : sea.spectrum.a)
    for (const double mean : harmonic) EXPECT_NEAR(mean, 0, 1e-12);
}

TEST(DescribedSea, IsWithoutEnergyToCompareAboveTheLastBin) {
  const DescribedSea sea = Describe({.waves = MeasuredWindSea(8, 1), .wind_speed_10m = 8, .tail_from = 1});
  EXPECT_TRUE(sea.assumed.level_unknown);
  EXPECT_EQ(sea.q, 1);
  // Above the last bin the tail has its whole weight, so there is no gap.
  const double gap = 0.5 * (WavenumberOfFrequency(0.6, kDeep) + WavenumberOfFrequency(1, kDeep));
  EXPECT_NEAR(Resampled(sea.spectrum, {gap}).s[0] / ElfouhailySpectrum(8, kDeep)(gap), 1, 5e-3);
}

TEST(DescribedSea, TurnsWithWindAndWaves) {
  const DescribedSea sea = Describe({.waves = Swell(1, 0.5), .wind_speed_10m = 5, .wind_from = 1});
  const DescribedSea turned = Describe({.waves = Swell(1, 0.5 + 2.1), .wind_speed_10m = 5, .wind_from = 1 + 2.1});
  for (std::size_t i = 0; i < sea.spectrum.size(); ++i) {
    EXPECT_NEAR(turned.spectrum.a[0][i], sea.spectrum.a[0][i], 1e-12);
    EXPECT_NEAR(turned.spectrum.b[0][i], sea.spectrum.b[0][i], 1e-12);
    EXPECT_EQ(turned.spectrum.s[i], sea.spectrum.s[i]);
  }
}

// One bin of width B measured over T: the variance has the relative error sqrt(2 / nu) = 1 / sqrt(B T).
TEST(ErrorOfSea, IsThatOfItsDegreesOfFreedom) {
  const std::vector<DirectionalEnergy> bins{{}, {.energy = 1}, {}};
  const auto waves = std::make_shared<BinnedSpectrum>(
      std::make_shared<const std::vector<double>>(std::vector{0.09, 0.1, 0.11}), bins, 0, 0.4);
  const SeaDescription description{.waves = waves, .wind_speed_10m = 0};
  // Over the triangle of half width 0.01 Hz the mean of f^4 is 1.01 f^4; trapezoids add the rest.
  const SeaError error = ErrorOfSea(description, 1200, [](double) { return 1.0; });
  EXPECT_NEAR(error.sampling * std::sqrt(0.01 * 1200), 1, 0.03);
  EXPECT_EQ(error.tail, 0);
  EXPECT_EQ(error.total, error.sampling);
  EXPECT_EQ(ErrorOfSea(description, kDeep, [](double) { return 1.0; }).sampling, 0);
}

TEST(ErrorOfSea, IsHalfTheDifferenceOfTheTailRules) {
  SeaDescription description{.waves = MeasuredWindSea(8, 1.6), .wind_speed_10m = 8, .wind_from = 1};
  const auto below_20 = [](double k) { return k < 20 ? 1.0 : 0.0; };
  const auto variance = [&](TailRule rule) {
    description.tail = rule;
    return MeanSquareSlopeBelow(Describe(description).spectrum, 20);
  };
  const double range = variance(TailRule::kLevel) - variance(TailRule::kWind);
  const double v = variance(TailRule::kRelax);
  const SeaError error = ErrorOfSea(description, kDeep, below_20);
  EXPECT_NEAR(error.tail, 0.5 * range / v, 0.01 * error.tail);
  EXPECT_GT(error.tail, 0.05);
  EXPECT_EQ(ErrorOfSea({.wind_speed_10m = 8}, 1200, below_20).total, 0);
}

}  // namespace
}  // namespace albtpu
