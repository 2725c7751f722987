#include "sea/spectra/wind_sea.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sea/spectra/wave_spreading.h"

namespace albtpu {
namespace {

// Equal steps over a full turn: exact for integer s, where the integrand is a trigonometric polynomial.
template <typename Weight>
double IntegralOverTurn(const Cosine2sSpreading& spreading, Weight weight) {
  constexpr int kSteps = 4096;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double psi = 2 * std::numbers::pi * i / kSteps;
    sum += spreading(psi) * weight(psi) * 2 * std::numbers::pi / kSteps;
  }
  return sum;
}

TEST(Cosine2sSpreading, IntegratesToOne) {
  for (const double s : {1.0, 2.0, 5.0, 10.0})
    EXPECT_NEAR(IntegralOverTurn(Cosine2sSpreading(s), [](double) { return 1.0; }), 1, 1e-12) << s;
  // |cos|^5 has a kink in its fifth derivative, so equal steps are no longer exact.
  EXPECT_NEAR(IntegralOverTurn(Cosine2sSpreading(2.5), [](double) { return 1.0; }), 1, 1e-9);
}

TEST(Cosine2sSpreading, HasSlopeVariancesAlongAndAcrossTheWindInTheRatioSevenToFive) {
  const Cosine2sSpreading spreading(2);
  EXPECT_NEAR(IntegralOverTurn(spreading, [](double psi) { return std::pow(std::cos(psi), 2); }), 7.0 / 12, 1e-12);
  EXPECT_NEAR(IntegralOverTurn(spreading, [](double psi) { return std::pow(std::sin(psi), 2); }), 5.0 / 12, 1e-12);
}

TEST(Cosine2sSpreading, IsGreatestDownwindAndZeroUpwind) {
  const Cosine2sSpreading spreading(2);
  EXPECT_NEAR(spreading(0), 4 / (3 * std::numbers::pi), 1e-15);  // 2^3 / pi * Gamma(3)^2 / Gamma(5)
  EXPECT_NEAR(spreading(std::numbers::pi), 0, 1e-60);
  EXPECT_DOUBLE_EQ(spreading(0.7), spreading(-0.7));
}

// At the peak the enhancement is gamma itself; far from it there is none. Between Omega 1 and 5 gamma follows the
// formula.
TEST(JonswapPeak, EnhancesThePeakByGammaAndNothingElse) {
  for (const double omega : {1.0, 2.0, 5.0}) EXPECT_DOUBLE_EQ(JonswapPeak(omega)(1), 1.7 + 6 * std::log10(omega));
  EXPECT_NEAR(JonswapPeak(2)(10), 1, 1e-12);
  EXPECT_NEAR(JonswapPeak(2)(0.05), 1, 1e-6);
}

TEST(JonswapPeak, KeepsGammaBeyondItsRange) {
  EXPECT_EQ(JonswapPeak(0.84)(1), JonswapPeak(1)(1));
  EXPECT_EQ(JonswapPeak(20)(1), JonswapPeak(5)(1));
}

TEST(WindProfile, HasTheDragCoefficientOfWu) {
  EXPECT_NEAR(std::pow(FrictionVelocity(10) / 10, 2), 1.45e-3, 1e-9);
  EXPECT_NEAR(std::pow(FrictionVelocity(3) / 3, 2), 0.995e-3, 1e-9);
}

TEST(WindProfile, IsLogarithmic) {
  EXPECT_EQ(WindSpeedAt(10, 7), 7);
  EXPECT_NEAR(WindSpeedAt(20, 7) - 7, 7 - WindSpeedAt(5, 7), 1e-12);
  // u* / 0.4 for each factor of e in height.
  EXPECT_NEAR(WindSpeedAt(10 * std::exp(1), 7) - 7, FrictionVelocity(7) / 0.4, 1e-12);
}

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
