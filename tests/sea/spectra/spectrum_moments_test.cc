#include "sea/spectra/spectrum_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sea/spectra/apel_spectrum.h"
#include "sea/spectra/elfouhaily_spectrum.h"
#include "sea/spectra/wave_spectrum.h"
#include "sea/spectra/wind_sea.h"
#include "tests/sea/spectra/deep_water.h"

namespace albtpu {
namespace {

HarmonicSpectrum PowerLaw(double power) {
  HarmonicSpectrum spectrum = FlatSea(SeaWavenumbers(), 1);
  for (std::size_t i = 0; i < spectrum.size(); ++i) spectrum.s[i] = std::pow(spectrum.k[i], power);
  return spectrum;
}

// Trapezoids are exact for straight lines.
TEST(SpectrumMoments, AreExactForStraightLines) {
  EXPECT_NEAR(ElevationVariance(PowerLaw(0)), 3500 - 0.004, 1e-9);
  EXPECT_NEAR(SignificantWaveHeight(PowerLaw(0)), 4 * std::sqrt(3500 - 0.004), 1e-9);
  EXPECT_NEAR(MeanSquareSlope(PowerLaw(-2)), 3500 - 0.004, 1e-9);
  EXPECT_NEAR(MeanSquareSlope(PowerLaw(-1)), 0.5 * 3500 * 3500, 1e-3);
}

TEST(SpectrumMoments, EndWithinAnInterval) {
  EXPECT_NEAR(MeanSquareSlopeBelow(PowerLaw(-1), 11), 0.5 * (121 - 0.004 * 0.004), 1e-9);
  EXPECT_EQ(MeanSquareSlopeBelow(PowerLaw(-1), 0.001), 0);
  EXPECT_EQ(MeanSquareSlopeBelow(PowerLaw(-1), 1e9), MeanSquareSlope(PowerLaw(-1)));
}

// Mean square slopes below 11 and 20 rad/m, 1e-4, computed by an independent script and rounded to integers.
TEST(SpectrumMoments, AreThoseOfTheWindSea) {
  struct Case {
    double wind_speed, apel_11, elfouhaily_11, apel_20, elfouhaily_20;
  };
  for (const Case& c : {Case{3, 98, 113, 137, 143},
                        {5, 170, 170, 217, 197},
                        {7, 224, 205, 274, 228},
                        {10, 286, 244, 340, 268},
                        {13, 333, 268, 390, 295}}) {
    const auto below = [&](const WaveSpectrum& spectrum, double k) {
      return 1e4 * MeanSquareSlopeBelow(Sampled(spectrum, SeaWavenumbers(), 1), k);
    };
    constexpr double kRounding = 0.5,
                     kTrapezoids = 4e-4 * 400;  // 5 % steps: k^2 (k^2 S)'' of twice k^2 S, over 12
    const ApelSpectrum apel(c.wind_speed, kFullyDeveloped);
    const ElfouhailySpectrum elfouhaily(c.wind_speed, kFullyDeveloped);
    EXPECT_NEAR(below(apel, 11), c.apel_11, kRounding + kTrapezoids) << c.wind_speed;
    EXPECT_NEAR(below(apel, 20), c.apel_20, kRounding + kTrapezoids) << c.wind_speed;
    EXPECT_NEAR(below(elfouhaily, 11), c.elfouhaily_11, kRounding + kTrapezoids) << c.wind_speed;
    EXPECT_NEAR(below(elfouhaily, 20), c.elfouhaily_20, kRounding + kTrapezoids) << c.wind_speed;
  }
}

TEST(DispersionRelation, IsSolvedToTwelveDigitsAtEachDepth) {
  for (double f = 0.001; f < 10; f *= 1.3) {
    for (double depth = 0.01; depth < 1e5; depth *= 1.7) {
      const double k = WavenumberOfFrequency(f, depth);
      EXPECT_NEAR(FrequencyOfWavenumber(k, depth) / f, 1, 1e-12) << f << " Hz in " << depth << " m";
    }
  }
}

TEST(DispersionRelation, HasItsDeepAndItsShallowLimit) {
  const double omega = 2 * std::numbers::pi * 0.1;
  EXPECT_EQ(WavenumberOfFrequency(0.1, kDeep), omega * omega / kGravity);
  EXPECT_EQ(WavenumberOfFrequency(0.1, 1e4), omega * omega / kGravity);
  // k = omega / sqrt(g h) (1 + omega^2 h / (6 g)) for small k h, to the square of the last term.
  const double small = omega * omega * 0.01 / (6 * kGravity);
  EXPECT_NEAR(WavenumberOfFrequency(0.1, 0.01) / (omega / std::sqrt(kGravity * 0.01)), 1 + small, 2 * small * small);
  EXPECT_EQ(Shallowness(1, kDeep), 0);
  EXPECT_NEAR(Shallowness(1e-5, 1), 1, 1e-9);
}

TEST(DispersionRelation, HasTheGroupVelocityOfItsDerivative) {
  for (const double depth : {0.5, 5.0, 50.0, kDeep}) {
    for (const double k : {0.01, 0.3, 2.0}) {
      const double h = 1e-5 * k;
      const double slope = (FrequencyOfWavenumber(k + h, depth) - FrequencyOfWavenumber(k - h, depth)) / (2 * h);
      EXPECT_NEAR(FrequencySlope(k, depth) / slope, 1, 1e-8);
    }
  }
  // Deep water: half the phase speed. Shallow: sqrt(g h).
  EXPECT_NEAR(FrequencySlope(2, kDeep) * 2 * std::numbers::pi, 0.5 * std::sqrt(kGravity / 2), 1e-14);
  EXPECT_NEAR(FrequencySlope(1e-4, 1) * 2 * std::numbers::pi, std::sqrt(kGravity), 1e-7);
}

}  // namespace
}  // namespace albtpu
