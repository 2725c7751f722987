#include "sea/spectra/spectrum_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sea/spectra/apel_spectrum.h"
#include "sea/spectra/elfouhaily_spectrum.h"

namespace albtpu {
namespace {

constexpr double kFullyDeveloped = std::numeric_limits<double>::infinity();

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

}  // namespace
}  // namespace albtpu
