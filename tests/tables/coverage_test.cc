#include "tables/coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tables/query/interpolation.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu {
namespace {

// The probability that |(x, y)| < radius for standard deviations 1 and q > 0, computed differently from
// coverage.cc: the integral over x of its density times P(|y| < sqrt(radius^2 - x^2)), with x = radius sin t.
double ProbabilityWithin(double radius, double q) {
  constexpr int kSteps = 20'000;
  const double step = std::numbers::pi / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = -std::numbers::pi / 2 + (i + 0.5) * step;
    const double x = radius * std::sin(t), y = radius * std::cos(t);
    sum += std::exp(-x * x / 2) * std::erf(y / (q * std::numbers::sqrt2)) * y;
  }
  return sum * step / std::sqrt(2 * std::numbers::pi);
}

PulseUncertainty Uncertainty(float along, float cross) {
  PulseUncertainty uncertainty;
  uncertainty.outcome = Outcome::kInterpolated;
  uncertainty.values = {along, cross, 2, 0.5f, -0.25f, 0.125f};
  uncertainty.standard_errors = {0.1f, 0.2f, 0.4f, 0.05f, 0.03f, 0.02f};
  uncertainty.radius_over_thu = RadiusOverThu(uncertainty.values);
  return uncertainty;
}

constexpr double kOneDimension = 1.959963984540054 / 2;

TEST(Coverage, OfOneDimensionIsTheNormalQuantile) { EXPECT_NEAR(RadiusFactor95(0), kOneDimension, 1e-9); }

// P(r) = 1 - exp(-r^2 / 2): the radius is sqrt(-2 ln 0.05), over 2 sqrt(2).
TEST(Coverage, OfAnIsotropicNormalIsTheRayleighQuantile) {
  EXPECT_NEAR(RadiusFactor95(1), std::sqrt(-2 * std::log(0.05)) / (2 * std::numbers::sqrt2), 1e-9);
}

// Where the radius changes by a millionth of THU, the probability changes by at least 2e-7.
TEST(Coverage, RadiusContains95PercentForEveryAxisRatio) {
  for (double q : {0.02, 0.05, 0.1, 0.1234, 0.2, 0.33333, 0.5, 0.6543, 0.7777, 0.85, 0.95, 0.9999})
    EXPECT_NEAR(ProbabilityWithin(2 * std::hypot(1, q) * RadiusFactor95(q), q), 0.95, 2e-7) << q;
}

TEST(Coverage, RadiusFactorFallsWithTheAxisRatio) {
  for (int i = 1; i <= 5000; ++i) EXPECT_LT(RadiusFactor95(i / 5000.0), RadiusFactor95((i - 1) / 5000.0)) << i;
}

TEST(Coverage, TwoSigmaChangesNothing) {
  const PulseUncertainty before = Uncertainty(2, 1), after = WithCoverage(before, Coverage::kTwoSigma);
  EXPECT_EQ(after.values, before.values);
  EXPECT_EQ(after.standard_errors, before.standard_errors);
}

TEST(Coverage, P95RestatesValuesAndTheirStandardErrors) {
  const PulseUncertainty u = WithCoverage(Uncertainty(1, 2), Coverage::kP95);
  const double radius_factor = RadiusFactor95(0.5);
  EXPECT_FLOAT_EQ(u[Quantity::kRefractionAlongWind], static_cast<float>(kOneDimension));
  EXPECT_FLOAT_EQ(u[Quantity::kRefractionCrossWind], static_cast<float>(2 * kOneDimension));
  EXPECT_FLOAT_EQ(u[Quantity::kTvu], static_cast<float>(0.5 * kOneDimension));
  EXPECT_FLOAT_EQ(u[Quantity::kThu], static_cast<float>(2 * radius_factor));
  EXPECT_FLOAT_EQ(u.standard_errors[Index(Quantity::kThu)], static_cast<float>(0.4 * radius_factor));
  EXPECT_FLOAT_EQ(u.standard_errors[Index(Quantity::kTvu)], static_cast<float>(0.05 * kOneDimension));
}

TEST(Coverage, P95DoesNotChangeBiases) {
  const PulseUncertainty u = WithCoverage(Uncertainty(1, 2), Coverage::kP95);
  EXPECT_EQ(u[Quantity::kBiasAlongBeam], -0.25f);
  EXPECT_EQ(u[Quantity::kBiasVertical], 0.125f);
  EXPECT_EQ(u.standard_errors[Index(Quantity::kBiasAlongBeam)], 0.03f);
}

TEST(Coverage, IsTheSameWhicheverRefractionIsLarger) {
  EXPECT_EQ(WithCoverage(Uncertainty(1, 2), Coverage::kP95)[Quantity::kThu],
            WithCoverage(Uncertainty(2, 1), Coverage::kP95)[Quantity::kThu]);
}

TEST(Coverage, TreatsAFlatSeaAsOneDimension) {
  EXPECT_FLOAT_EQ(WithCoverage(Uncertainty(0, 0), Coverage::kP95)[Quantity::kThu],
                  static_cast<float>(2 * kOneDimension));
}

TEST(Coverage, WithoutAzimuthIsTheLargerRadiusNotThatOfTheLargerThu) {
  PulseUncertainty round = Uncertainty(1, 1), slender = Uncertainty(1, 0.1f);
  slender.values[Index(Quantity::kThu)] = 1.9f;  // Below the 2 m of `round`.
  const float radius = WithCoverage(slender, Coverage::kP95)[Quantity::kThu];
  ASSERT_GT(radius, WithCoverage(round, Coverage::kP95)[Quantity::kThu]);
  for (const PulseUncertainty& both : {LargerOf(round, slender), LargerOf(slender, round)}) {
    EXPECT_EQ(both[Quantity::kThu], 2);
    EXPECT_FLOAT_EQ(WithCoverage(both, Coverage::kP95)[Quantity::kThu], radius);
  }
}

TEST(Coverage, GivesNoNumbersWhereThereAreNone) {
  PulseUncertainty none = Uncertainty(1, 1);
  none.outcome = Outcome::kOutOfDomain;
  none.values.fill(std::numeric_limits<float>::quiet_NaN());
  for (float value : WithCoverage(none, Coverage::kP95).values) EXPECT_TRUE(std::isnan(value));
}

}  // namespace
}  // namespace albtpu
