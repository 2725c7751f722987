#include "budget/beams/arctangent.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace albtpu {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Arctangent, AgreesWithTheStandardLibraryInAllDirections) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> direction(-kPi, kPi), exponent(-30, 30);
  for (int i = 0; i < 1'000'000; ++i) {
    const double angle = direction(random), length = std::exp2(exponent(random));
    const double x = length * std::cos(angle), y = length * std::sin(angle);
    // The four roundings of numbers below pi, and 1e-17 of the polynomial.
    ASSERT_NEAR(Arctangent(y, x), std::atan2(y, x), 1e-15) << y << " " << x;
  }
}

TEST(Arctangent, KeepsTheRelativePrecisionOfSmallAngles) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-300, -2);
  for (int i = 0; i < 100'000; ++i) {
    const double y = std::pow(10, exponent(random));
    // Three roundings: of the quotient, of the correction and of the sum.
    ASSERT_NEAR(Arctangent(y, 1) / std::atan(y), 1, 3 * std::numeric_limits<double>::epsilon()) << y;
  }
}

TEST(Arctangent, IsExactAlongTheAxesAndDiagonals) {
  EXPECT_EQ(Arctangent(0, 0), 0);
  EXPECT_EQ(Arctangent(0, 2), 0);
  EXPECT_EQ(Arctangent(2, 2), kPi / 4);
  EXPECT_EQ(Arctangent(2, 0), kPi / 2);
  EXPECT_EQ(Arctangent(2, -2), kPi - kPi / 4);
  EXPECT_EQ(Arctangent(0, -2), kPi);
  EXPECT_EQ(Arctangent(-0.0, -2), kPi);
  EXPECT_EQ(Arctangent(-2, 0), -kPi / 2);
  EXPECT_EQ(Arctangent(-2, 2), -kPi / 4);
}

TEST(Arctangent, IsNotANumberOfWhatIsNone) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(Arctangent(nan, 1)));
  EXPECT_TRUE(std::isnan(Arctangent(1, nan)));
  EXPECT_TRUE(std::isnan(Arctangent(infinity, infinity)));
}

}  // namespace
}  // namespace albtpu
