#include "sea/spectra/spectral_tail.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "sea/spectra/binned_spectrum.h"
#include "sea/spectra/spectrum_moments.h"
#include "tests/sea/spectra/deep_water.h"

namespace albtpu {
namespace {

TEST(TailWeight, RisesThroughOneHalfAtTheCutoff) {
  EXPECT_EQ(TailWeight(0.6, 0.6), 0.5);
  EXPECT_NEAR(TailWeight(0.6 * std::exp(0.15), 0.6), 0.5 * (1 + std::tanh(1)), 1e-14);
  EXPECT_NEAR(TailWeight(0.06, 0.6), 0, 1e-13);
  EXPECT_NEAR(TailWeight(6, 0.6), 1, 1e-13);
}

TEST(LevelPower, FollowsItsRule) {
  EXPECT_EQ(LevelPower(TailRule::kWind, 3, 1), 0);
  EXPECT_EQ(LevelPower(TailRule::kLevel, 3, 1), 1);
  EXPECT_EQ(LevelPower(TailRule::kRelax, 1, 1), 1);
  EXPECT_NEAR(LevelPower(TailRule::kRelax, std::sqrt(10), 1), 0.5, 1e-14);
  EXPECT_EQ(LevelPower(TailRule::kRelax, 10, 1), 0);
  EXPECT_EQ(LevelPower(TailRule::kRelax, 100, 1), 0);
}

TEST(WindWaves, AreThoseOfTheSampledSpectrum) {
  const ElfouhailySpectrum wind(7, kDeep);
  const HarmonicSpectrum waves = WindWaves(wind, SeaWavenumbers());
  const HarmonicSpectrum sampled = Sampled(wind, SeaWavenumbers(), kSeaHarmonics);
  EXPECT_EQ(waves.s, sampled.s);
  for (std::size_t n = 0; n < kSeaHarmonics; ++n) {
    for (std::size_t i = 0; i < waves.size(); ++i) {
      EXPECT_NEAR(waves.a[n][i], sampled.a[n][i], 1e-14);
      EXPECT_NEAR(waves.b[n][i], sampled.b[n][i], 1e-14);
    }
  }
}

// Elfouhaily's spectrum as bins, times a factor.
BinnedSpectrum Measured(const ElfouhailySpectrum& wind, double depth, double factor) {
  std::vector<double> centres;
  std::vector<DirectionalEnergy> bins;
  for (double f = 0.05; f < 0.5; f += 0.01) {
    const double k = WavenumberOfFrequency(f, depth);
    centres.push_back(f);
    bins.push_back({.energy = factor * wind(k) / FrequencySlope(k, depth)});
  }
  return BinnedSpectrum(std::make_shared<const std::vector<double>>(std::move(centres)), bins, 0, 0.4);
}

TEST(LevelAtCutoff, IsTheRatioOfTheSpectra) {
  const ElfouhailySpectrum wind(8, kDeep);
  for (const double depth : {3.0, kDeep}) {
    const TailLevel level = LevelAtCutoff(Measured(wind, depth, 1.3), wind, depth, 0.4);
    EXPECT_NEAR(level.q, 1.3, 1e-12);
    EXPECT_FALSE(level.held);
    EXPECT_EQ(level.compared, 11);  // 0.30 to 0.40 Hz
  }
}

TEST(LevelAtCutoff, IsHeldToAFactorOfTwo) {
  const ElfouhailySpectrum wind(8, kDeep);
  EXPECT_EQ(LevelAtCutoff(Measured(wind, kDeep, 5), wind, kDeep, 0.4).q, 2);
  EXPECT_EQ(LevelAtCutoff(Measured(wind, kDeep, 0.01), wind, kDeep, 0.4).q, 0.5);
  EXPECT_TRUE(LevelAtCutoff(Measured(wind, kDeep, 0.01), wind, kDeep, 0.4).held);
}

// Three decimals leave zeros at high frequencies: as energies they would make the geometric mean 0.
TEST(LevelAtCutoff, LeavesOutBinsThatWereRoundedToZero) {
  const ElfouhailySpectrum wind(8, kDeep);
  const BinnedSpectrum full = Measured(wind, kDeep, 1.3);
  std::vector<double> centres;
  std::vector<DirectionalEnergy> bins;
  for (std::size_t i = 0; i < full.size(); ++i) {
    centres.push_back(full.centre(i));
    bins.push_back(i % 2 == 0 ? full.bin(i) : DirectionalEnergy{});
  }
  const BinnedSpectrum gaps(std::make_shared<const std::vector<double>>(std::move(centres)), bins, 0, 0.4);
  EXPECT_NEAR(LevelAtCutoff(gaps, wind, kDeep, 0.4).q, 1.3, 1e-12);
}

TEST(LevelAtCutoff, IsOneWithoutEnergyToCompare) {
  const ElfouhailySpectrum wind(8, kDeep);
  const TailLevel level = LevelAtCutoff(Measured(wind, kDeep, 1.3), wind, kDeep, 0.9);
  EXPECT_EQ(level.compared, 0);
  EXPECT_EQ(level.q, 1);
}

TEST(TailRule, HasAName) {
  for (const TailRule rule : {TailRule::kWind, TailRule::kRelax, TailRule::kLevel, TailRule::kNone})
    EXPECT_EQ(FindTailRule(Name(rule)), rule);
  EXPECT_EQ(Name(TailRule::kRelax), "relax");
  EXPECT_EQ(FindTailRule("calm"), std::nullopt);
}

}  // namespace
}  // namespace albtpu
