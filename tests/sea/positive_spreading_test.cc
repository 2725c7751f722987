#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "sea/sampled_spectrum.h"

namespace albtpu {
namespace {

constexpr double kPi = std::numbers::pi;

// The mean over the energy of f(psi), by a sum over the full turn, exact for smooth functions.
template <typename Function>
double Mean(const PositiveSpreading& spreading, const Function& f) {
  constexpr int kSteps = 2000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double psi = 2 * kPi * (i + 0.3) / kSteps;
    sum += spreading(psi) * f(psi) * 2 * kPi / kSteps;
  }
  return sum;
}

double Least(const PositiveSpreading& spreading) {
  double least = 1;
  for (double psi = 0; psi < kPi; psi += 0.001) least = std::min(least, spreading(psi));
  return least;
}

TEST(PositiveSpreading, IsTheSeriesWhereThatIsPositive) {
  const PositiveSpreading spreading({0.3, 0.05}, {-0.2, 0.1});
  for (const double psi : {0.0, 0.4, 2.0, -1.0, 5.0}) {
    const double series = 1 + 2 * (0.3 * std::cos(2 * psi) - 0.2 * std::sin(2 * psi) + 0.05 * std::cos(4 * psi) +
                                   0.1 * std::sin(4 * psi));
    EXPECT_NEAR(spreading(psi), series / (2 * kPi), 1e-15);
  }
}

TEST(PositiveSpreading, LooksAlikeAfterHalfATurn) {
  for (const double a : {0.2, 0.8}) {
    const PositiveSpreading spreading({a}, {0.1});
    for (const double psi : {0.0, 0.7, 2.5}) EXPECT_NEAR(spreading(psi), spreading(psi + kPi), 1e-12);
  }
}

// Whether or not harmonics that are not known follow as zeros. The ridge moves a harmonic by 1e-7 times a coefficient
// of some tens.
TEST(PositiveSpreading, HasTheHarmonicsThatItIsGiven) {
  for (const double axis : {0.0, 0.6, 2.0}) {
    for (const double r2 : {0.55, 0.8, 0.95}) {
      const PositiveSpreading spreading({r2 * std::cos(2 * axis), 0, 0}, {r2 * std::sin(2 * axis), 0, 0});
      EXPECT_GE(Least(spreading), 0);
      EXPECT_NEAR(Mean(spreading, [](double) { return 1; }), 1, 1e-9);
      EXPECT_NEAR(Mean(spreading, [&](double psi) { return std::cos(2 * (psi - axis)); }), r2, 1e-5);
      EXPECT_NEAR(Mean(spreading, [&](double psi) { return std::sin(2 * (psi - axis)); }), 0, 1e-5);
    }
  }
}

// cos^2s(psi / 2) with s = 25 on a frozen surface, of which the harmonics 2 to 12 are known. Their series is negative.
TEST(PositiveSpreading, HasAllHarmonicsOfANarrowSwell) {
  constexpr double kS = 25;
  std::vector<double> a, b(6);
  double product = 1;
  for (int n = 1; n <= 12; ++n) {
    product *= (kS - n + 1) / (kS + n);
    if (n % 2 == 0) a.push_back(product);
  }
  const PositiveSpreading spreading(a, b);
  EXPECT_GE(Least(spreading), 0);
  for (int n = 1; n <= 6; ++n)
    EXPECT_NEAR(Mean(spreading, [&](double psi) { return std::cos(2 * n * psi); }), a[n - 1], 1e-5) << n;
  // The harmonics that are not given come out nearly right as well.
  for (int n = 13; n <= 14; ++n) product *= (kS - n + 1) / (kS + n);
  EXPECT_NEAR(Mean(spreading, [&](double psi) { return std::cos(14 * psi); }), product, 0.02);
}

TEST(PositiveSpreading, ExistsForHarmonicsThatNoDensityHas) {
  for (const auto& a : std::vector<std::vector<double>>{{1}, {1.2}, {0.95, 0.1}, {0, -1.5, 0.3}}) {
    const PositiveSpreading spreading(a, std::vector<double>(a.size()));
    EXPECT_GE(Least(spreading), 0);
    EXPECT_NEAR(Mean(spreading, [](double) { return 1; }), 1, 1e-3);
  }
}

}  // namespace
}  // namespace albtpu
