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

}  // namespace
}  // namespace albtpu
