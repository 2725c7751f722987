#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sea/spectra/spectrum_moments.h"
#include "sea/spectra/wave_spectrum.h"

namespace albtpu {
namespace {

constexpr double kDeep = std::numeric_limits<double>::infinity();

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
