#include "generator/math/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <span>

#include "generator/math/random_stream.h"

namespace albtpu {
namespace {

Eigen::ArrayXd NormalSample(int count, std::uint32_t realization) {
  Eigen::ArrayXd sample(count);
  NormalStream(11, 0, realization).Fill(std::span<double>(sample.data(), count));
  return sample;
}

TEST(Statistics, OfFourNumbersEqualTheCalculationByHand) {
  const Eigen::ArrayXd sample{{1, 2, 3, 6}};  // deviations -2, -1, 0, 3
  EXPECT_DOUBLE_EQ(Mean(sample).value, 3);
  EXPECT_DOUBLE_EQ(Mean(sample).standard_error, std::sqrt(14.0 / 3 / 4));
  EXPECT_DOUBLE_EQ(TwoSigma(sample).value, 2 * std::sqrt(14.0 / 3));
  // The squares 4, 1, 0, 9 have the mean 3.5 and the variance 49/3.
  EXPECT_DOUBLE_EQ(TwoSigma(sample).standard_error, std::sqrt(49.0 / 3 / 4 / (14.0 / 3)));
}

TEST(Statistics, OfAConstantSampleAreZero) {
  const Eigen::ArrayXd same = Eigen::ArrayXd::Constant(10, 0.25);
  EXPECT_EQ(TwoSigma(same).value, 0);
  EXPECT_EQ(TwoSigma(same).standard_error, 0);
  EXPECT_EQ(Mean(same).standard_error, 0);
}

// The standard error of a normal sample's standard deviation is sigma / sqrt(2n). The estimate of that standard error
// has itself a relative scatter of a little more than 1 / sqrt(n).
TEST(Statistics, OfANormalSampleHaveTheTextbookStandardErrors) {
  constexpr int kCount = 100000;
  constexpr double kSigma = 3;
  const Eigen::ArrayXd x = kSigma * NormalSample(kCount, 0) + 7, y = kSigma * NormalSample(kCount, 1);
  EXPECT_NEAR(Mean(x).value, 7, 4 * kSigma / std::sqrt(kCount));
  EXPECT_NEAR(Mean(x).standard_error / (kSigma / std::sqrt(kCount)), 1, 0.02);
  EXPECT_NEAR(TwoSigma(x).value, 2 * kSigma, 4 * 2 * kSigma / std::sqrt(2.0 * kCount));
  EXPECT_NEAR(TwoSigma(x).standard_error / (2 * kSigma / std::sqrt(2.0 * kCount)), 1, 0.02);
  // Two components of equal variance: the variance doubles, and its scatter is sqrt(2) times that of one component.
  const Eigen::ArrayXd squares = (x - x.mean()).square() + (y - y.mean()).square();
  const Estimate both = TwoSigmaOfSquares(squares, 2 * kSigma * kSigma / kCount);
  EXPECT_NEAR(both.value, 2 * std::sqrt(2.0) * kSigma, 4 * 2 * kSigma / std::sqrt(2.0 * kCount));
  EXPECT_NEAR(both.standard_error / (2 * kSigma / std::sqrt(2.0 * kCount)), 1, 0.02);
}

TEST(Statistics, OfRepeatedSamplesScatterByTheirStandardErrors) {
  constexpr int kRepetitions = 2000, kCount = 500;
  Eigen::ArrayXd of_normal(kRepetitions), of_square(kRepetitions);
  double claimed_of_normal = 0, claimed_of_square = 0;
  for (int i = 0; i < kRepetitions; ++i) {
    const Eigen::ArrayXd sample = NormalSample(kCount, 100 + i);
    const Estimate normal = TwoSigma(sample), square = TwoSigma(sample.square());
    of_normal[i] = normal.value;
    of_square[i] = square.value;  // chi-squared, as vertical errors at nadir nearly are
    claimed_of_normal += normal.standard_error / kRepetitions;
    claimed_of_square += square.standard_error / kRepetitions;
  }
  // The scatter of 2000 values is known to 1.6 %; the skewness of the distributions adds a few per cent.
  EXPECT_NEAR(0.5 * TwoSigma(of_normal).value / claimed_of_normal, 1, 0.05);
  EXPECT_NEAR(0.5 * TwoSigma(of_square).value / claimed_of_square, 1, 0.15);
}

TEST(Statistics, OfAMultipleOfTheControlAreExact) {
  const Eigen::ArrayXd c = NormalSample(100, 0);
  const Control of_squares{c.square(), 1};
  EXPECT_NEAR(TwoSigmaOfSquares(9 * c.square(), 0, of_squares).value, 6, 1e-12);
  EXPECT_NEAR(TwoSigmaOfSquares(9 * c.square(), 0, of_squares).standard_error, 0, 1e-12);
  EXPECT_NEAR(Mean(c + 5, Control{c, 0}).value, 5, 1e-12);
  EXPECT_NEAR(Mean(c + 5, Control{c, 0}).standard_error, 0, 1e-12);
}

// With fewer than 64 realizations, the fit would make the standard error too small.
TEST(Statistics, OfFewRealizationsIgnoreTheControl) {
  const Eigen::ArrayXd c = NormalSample(63, 0), sample = c + 0.1 * NormalSample(63, 1);
  const Estimate with = TwoSigmaOfSquares(sample.square(), 0, Control{c.square(), 1});
  const Estimate without = TwoSigmaOfSquares(sample.square(), 0);
  EXPECT_EQ(with.value, without.value);
  EXPECT_EQ(with.standard_error, without.standard_error);
}

TEST(Statistics, WithAControlAreUnbiasedAndScatterByTheirStandardErrors) {
  constexpr int kRepetitions = 2000, kCount = 64;
  Eigen::ArrayXd variances(kRepetitions), values(kRepetitions), means(kRepetitions);
  double claimed = 0, claimed_of_mean = 0, claimed_without = 0;
  for (int i = 0; i < kRepetitions; ++i) {
    const Eigen::ArrayXd c = NormalSample(kCount, 2 * i), rest = 0.1 * NormalSample(kCount, 2 * i + 1);
    const Eigen::ArrayXd sample = 0.97 * c + rest + 0.02 * (c.square() - 1);
    const Estimate spread = TwoSigmaOfSquares(sample.square(), 0, Control{c.square(), 1});  // the mean is known
    const Estimate mean = Mean(sample, Control{c, 0});
    variances[i] = spread.value * spread.value / 4;
    values[i] = spread.value;
    means[i] = mean.value;
    claimed += spread.standard_error / kRepetitions;
    claimed_of_mean += mean.standard_error / kRepetitions;
    claimed_without += TwoSigma(sample).standard_error / kRepetitions;
  }
  const double truth = 0.97 * 0.97 + 0.01 + 2 * 0.02 * 0.02;
  EXPECT_NEAR(variances.mean(), truth, 4 * Mean(variances).standard_error);
  EXPECT_NEAR(means.mean(), 0, 4 * Mean(means).standard_error);
  // The scatter of 2000 values is known to 1.6 %. Each standard error comes from 64 realizations, which know it to 9 %
  // with a slight skewness.
  EXPECT_NEAR(0.5 * TwoSigma(values).value / claimed, 1, 0.06);
  EXPECT_NEAR(0.5 * TwoSigma(means).value / claimed_of_mean, 1, 0.06);
  EXPECT_LT(claimed, 0.25 * claimed_without);
}

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
