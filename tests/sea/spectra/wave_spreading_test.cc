#include "sea/spectra/wave_spreading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sea/spectra/wind_sea.h"

namespace albtpu {
namespace {

double MeanCosine(double s, int harmonic) {
  const Cosine2sSpreading spreading(s);
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double psi = 2 * std::numbers::pi * i / kSteps;
    sum += spreading(psi) * std::cos(harmonic * psi) * 2 * std::numbers::pi / kSteps;
  }
  return sum;
}

TEST(CosineSpreading, HasTheHarmonicsOfItsIntegral) {
  for (const double s : {0.7, 1.0, 2.0, 5.5, 10.0, 75.0}) {
    const auto means = Cosine2sHarmonics(s);
    for (std::size_t n = 0; n < kSeaHarmonics; ++n)
      EXPECT_NEAR(means[n], MeanCosine(s, 2 * static_cast<int>(n) + 2), 1e-8) << "s " << s << ", n " << n;
  }
}

TEST(CosineSpreading, IsIsotropicOrLongCrestedAtItsLimits) {
  for (const double mean : Cosine2sHarmonics(0)) EXPECT_EQ(mean, 0);
  for (const double mean : Cosine2sHarmonics(std::numeric_limits<double>::infinity())) EXPECT_EQ(mean, 1);
  for (const double mean : Cosine2sHarmonics(Cosine2sOfSpread(0))) EXPECT_EQ(mean, 1);
  EXPECT_NEAR(Cosine2sOfSpread(std::numbers::sqrt2), 0, 1e-12);
}

// The definition of the circular standard deviation, with r1 from the integral.
TEST(CosineSpreading, HasTheStatedStandardDeviation) {
  for (const double degrees : {10.0, 18.0, 30.0, 60.0}) {
    const double spread = degrees * std::numbers::pi / 180;
    EXPECT_NEAR(std::sqrt(2 * (1 - MeanCosine(Cosine2sOfSpread(spread), 1))), spread, 1e-8);
  }
}

TEST(MitsuyasuSpreading, IsNarrowestAtThePeak) {
  EXPECT_EQ(MitsuyasuS(1), 10);
  EXPECT_NEAR(MitsuyasuS(0.5), 10 / 32.0, 1e-14);
  EXPECT_NEAR(MitsuyasuS(4), 10 / 32.0, 1e-14);
}

}  // namespace
}  // namespace albtpu
