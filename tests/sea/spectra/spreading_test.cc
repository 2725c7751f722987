#include "sea/spectra/spreading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

// Equal steps over a full turn: exact for the trigonometric polynomials that integer s gives.
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
  for (const double s : {1.0, 2.0, 5.0, 10.0}) {
    EXPECT_NEAR(IntegralOverTurn(Cosine2sSpreading(s), [](double) { return 1.0; }), 1, 1e-12) << s;
  }
  // |cos|^5 has a kink in its fifth derivative, so equal steps are no longer exact.
  EXPECT_NEAR(IntegralOverTurn(Cosine2sSpreading(2.5), [](double) { return 1.0; }), 1, 1e-9);
}

TEST(Cosine2sSpreading, SharesSlopeVarianceSevenToFiveAlongAndAcrossTheWind) {
  const Cosine2sSpreading spreading(2);
  EXPECT_NEAR(IntegralOverTurn(spreading, [](double psi) { return std::pow(std::cos(psi), 2); }), 7.0 / 12,
              1e-12);
  EXPECT_NEAR(IntegralOverTurn(spreading, [](double psi) { return std::pow(std::sin(psi), 2); }), 5.0 / 12,
              1e-12);
}

TEST(Cosine2sSpreading, IsGreatestDownwindAndZeroUpwind) {
  const Cosine2sSpreading spreading(2);
  EXPECT_NEAR(spreading(0), 4 / (3 * std::numbers::pi), 1e-15);  // 2^3 / pi * Gamma(3)^2 / Gamma(5)
  EXPECT_NEAR(spreading(std::numbers::pi), 0, 1e-60);
  EXPECT_DOUBLE_EQ(spreading(0.7), spreading(-0.7));
}

}  // namespace
}  // namespace albtpu
