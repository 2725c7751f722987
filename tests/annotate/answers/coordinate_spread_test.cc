#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "annotate/answers/uncertainty_summary.h"

namespace albtpu::annotate {
namespace {

TEST(CoordinateSpread, IsExactWhereAllNumbersAreTheSame) {
  for (const float number : {60.0f, -0.3f, 0.0f, -0.0f, 1e30f, 1e-40f}) {
    CoordinateSpread spread;
    for (int i = 0; i < 5; ++i) spread.Add(number);
    EXPECT_EQ(spread.least(), number);
    EXPECT_EQ(spread.middle(), number);
    EXPECT_EQ(spread.greatest(), number);
    EXPECT_EQ(spread.count(), 5u);
  }
}

TEST(CoordinateSpread, FindsTheMedianWithinASixteenth) {
  std::mt19937 random(1);
  for (const double centre : {-30.0, -1.0, 0.002, 5.0, 700.0}) {
    std::normal_distribution<float> normal(static_cast<float>(centre), static_cast<float>(std::abs(centre) / 4));
    CoordinateSpread spread;
    std::vector<float> numbers(1001);
    for (float& number : numbers) spread.Add(number = normal(random));
    std::sort(numbers.begin(), numbers.end());
    EXPECT_EQ(spread.least(), numbers.front());
    EXPECT_EQ(spread.greatest(), numbers.back());
    EXPECT_NEAR(spread.middle(), numbers[500], std::abs(numbers[500]) / 16);
  }
}

TEST(CoordinateSpread, OutliersDoNotMoveTheMedian) {
  CoordinateSpread spread;
  for (const float number : {60.0f, 60.0f, 1e38f, 60.0f, -1e38f}) spread.Add(number);
  EXPECT_NEAR(spread.middle(), 60, 60.0 / 16);
}

TEST(CoordinateSpread, MergesToTheSpreadOfAllNumbersInAnyOrder) {
  CoordinateSpread low, high, all, merged, reverse, none;
  for (int i = -50; i < 100; ++i) {
    const auto number = static_cast<float>(i) / 3;
    (i < 20 ? low : high).Add(number);
    all.Add(number);
  }
  for (const CoordinateSpread* part : {&low, &none, &high}) merged.Merge(*part);
  for (const CoordinateSpread* part : {&high, &low}) reverse.Merge(*part);
  for (const CoordinateSpread* both : {&merged, &reverse}) {
    EXPECT_EQ(both->count(), all.count());
    EXPECT_EQ(both->least(), all.least());
    EXPECT_EQ(both->middle(), all.middle());
    EXPECT_EQ(both->greatest(), all.greatest());
  }
}

}  // namespace
}  // namespace albtpu::annotate
