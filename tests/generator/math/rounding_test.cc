#include <gtest/gtest.h>

#include <cmath>

#include "generator/math/statistics.h"

namespace albtpu {
namespace {

TEST(Rounding, KeepsTheGivenNumberOfBinaryDigits) {
  EXPECT_EQ(RoundToBits(0b1011'0110, 4), 0b1011'0000);
  EXPECT_EQ(RoundToBits(0b1011'1001, 4), 0b1100'0000);
  EXPECT_EQ(RoundToBits(-0.71, 2), -0.75);
  EXPECT_EQ(RoundToBits(15.9, 4), 16);
  EXPECT_EQ(RoundToBits(0, 4), 0);
}

TEST(Rounding, RoundsTiesToEven) {
  EXPECT_EQ(RoundToBits(4.5, 3), 4);
  EXPECT_EQ(RoundToBits(5.5, 3), 6);
  EXPECT_EQ(RoundToBits(-4.5, 3), -4);
}

TEST(Rounding, ErrsByAtMostHalfOfTheLastDigit) {
  for (double value = 1e-6; value < 1e3; value *= 1.0137) {
    for (const int bits : {1, 4, 13, 24})
      EXPECT_LE(std::abs(RoundToBits(value, bits) / value - 1), std::exp2(-bits)) << value;
    EXPECT_EQ(static_cast<float>(RoundToBits(value, 24)), RoundToBits(value, 24)) << value;
  }
}

TEST(Rounding, KeepsAnEstimateWithinAnEighthOfItsStandardError) {
  for (const double relative_error : {1e-5, 1e-3, 0.01, 0.3, 2.0, 40.0}) {
    for (double value = -3; value < 3; value += 0.0173) {
      const double error = relative_error * std::abs(value);
      const Estimate rounded = Rounded({value, error});
      EXPECT_LE(std::abs(rounded.value - value), std::max(error / 8, std::exp2(-kValueBits) * std::abs(value)));
      EXPECT_LE(std::abs(rounded.standard_error / error - 1), std::exp2(-kStandardErrorBits));
      EXPECT_EQ(Rounded(rounded).value, rounded.value) << value;
    }
  }
}

TEST(Rounding, TurnsAValueFarBelowItsStandardErrorIntoPositiveZero) {
  const double zero = Rounded({-1e-3, 1}).value;
  EXPECT_EQ(zero, 0);
  EXPECT_FALSE(std::signbit(zero));
  EXPECT_EQ(Rounded({0, 0.1}).value, 0);
  EXPECT_EQ(Rounded({0.5, 0}).value, 0.5);
}

}  // namespace
}  // namespace albtpu
