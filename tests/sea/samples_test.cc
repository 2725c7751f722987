#include "sea/samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

// Percentage points of Abramowitz and Stegun (1964), table 26.10, which has them for 2 tail.
TEST(StudentQuantile, AgreesWithTables) {
  EXPECT_NEAR(StudentQuantile(1, 0.025), 12.706, 5e-4);
  EXPECT_NEAR(StudentQuantile(2, 0.025), 4.303, 5e-4);
  EXPECT_NEAR(StudentQuantile(3, 0.005), 5.841, 5e-4);
  EXPECT_NEAR(StudentQuantile(14, 0.025), 2.145, 5e-4);
  EXPECT_NEAR(StudentQuantile(14, 0.005), 2.977, 5e-4);
  EXPECT_NEAR(StudentQuantile(120, 0.025), 1.980, 5e-4);
}

TEST(StudentQuantile, AgreesWithClosedForms) {
  EXPECT_NEAR(StudentQuantile(1, 0.1), std::tan(std::numbers::pi * 0.4), 1e-9);  // Cauchy's distribution.
  EXPECT_NEAR(StudentQuantile(2, 0.1), 0.8 * std::sqrt(2 / (1 - 0.64)), 1e-9);
  EXPECT_NEAR(StudentQuantile(7, 0.5), 0, 1e-9);
  EXPECT_NEAR(StudentQuantile(1'000'000, 0.025), 1.959964, 0.003);
}

// Of two degrees of freedom it is 1 - exp(-value / 2), of one erf(sqrt(value / 2)).
TEST(ChiSquareBelow, AgreesWithClosedFormsAndTables) {
  for (const double value : {0.01, 0.5, 2.0, 9.0, 40.0}) {
    EXPECT_NEAR(ChiSquareBelow(value, 2), 1 - std::exp(-value / 2), 1e-12);
    EXPECT_NEAR(ChiSquareBelow(value, 1), std::erf(std::sqrt(value / 2)), 1e-12);
    // Integrating by parts: of two degrees more.
    EXPECT_NEAR(ChiSquareBelow(value, 6.5),
                ChiSquareBelow(value, 4.5) - std::pow(value / 2, 2.25) * std::exp(-value / 2) / std::tgamma(3.25),
                1e-12);
  }
  EXPECT_EQ(ChiSquareBelow(0, 3), 0);
  // Abramowitz and Stegun (1964), table 26.8.
  EXPECT_NEAR(ChiSquareBelow(20.4831, 10), 0.975, 1e-6);
  EXPECT_NEAR(ChiSquareBelow(67.3276, 100), 0.005, 1e-6);
}

}  // namespace
}  // namespace albtpu
