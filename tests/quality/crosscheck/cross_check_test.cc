#include "quality/crosscheck/cross_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "quality/crosscheck/variance_fit.h"

namespace albtpu::quality {
namespace {

// Pairs of 12 lines with normal differences, whose predicted variances are a part of the true ones.
struct Truth {
  double air = 1, sea = 1;  // Factors of the true standard deviations.
  double rough = 0;         // m in a metre of distance.
  double offset = 0;        // m, of line 1.
};

std::vector<CrossPair> Pairs(const Truth& truth) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<CrossPair> pairs;
  for (int i = 0; i < 40'000; ++i) {
    CrossPair pair;
    pair.line_a = static_cast<std::uint16_t>(1 + i % 11);
    pair.line_b = static_cast<std::uint16_t>(pair.line_a + 1);
    pair.x = 6000 * uniform(random);
    pair.depth = static_cast<float>(20 * uniform(random));
    pair.incidence = 20;
    pair.variance_air = 0.01F;
    pair.variance_sea = 0.0002F * pair.depth * pair.depth;
    pair.distance = static_cast<float>(2 * uniform(random));
    pair.difference = static_cast<float>(std::sqrt(std::pow(truth.air, 2) * pair.variance_air +
                                                   std::pow(truth.sea, 2) * pair.variance_sea +
                                                   std::pow(truth.rough * pair.distance, 2)) *
                                             normal(random) +
                                         (pair.line_a == 1 ? truth.offset : 0));
    pairs.push_back(pair);
  }
  return pairs;
}

CrossCheck CheckOf(const Truth& truth) {
  std::vector<CrossPair> pairs = Pairs(truth);
  return CheckPairs(pairs).value();
}

TEST(CrossCheck, OfARightPredictionIsOne) {
  const CrossCheck check = CheckOf({});
  EXPECT_NEAR(check.chi_square, 1, 0.03);
  EXPECT_NEAR(check.factor.value, 1, 0.02);
  EXPECT_FALSE(check.factor.excludes(1));
  EXPECT_NEAR(check.median_factor, 1, 0.02);
  EXPECT_NEAR(check.beyond_three_sigma, 0.0027, 0.001);
  EXPECT_EQ(check.guilty, "");
  EXPECT_EQ(check.roughness, 0);
}

TEST(CrossCheck, TellsTheSharesApart) {
  const CrossCheck air = CheckOf({.air = 2});
  EXPECT_NEAR(air.factor_air.value, 2, 0.1);
  EXPECT_FALSE(air.factor_sea.excludes(1));
  EXPECT_EQ(air.guilty, "air");
  const CrossCheck sea = CheckOf({.sea = 0.5});
  EXPECT_NEAR(sea.factor_sea.value, 0.5, 0.1);
  EXPECT_FALSE(sea.factor_air.excludes(1));
  EXPECT_EQ(sea.guilty, "sea");
}

TEST(CrossCheck, LeavesOutTheRoughnessOfTheBottom) {
  const CrossCheck check = CheckOf({.rough = 0.08});
  EXPECT_NEAR(check.roughness, 0.08, 0.02);
  EXPECT_NEAR(check.chi_square, 1, 0.06);
}

TEST(CrossCheck, FindsALineThatLiesAbove) {
  const CrossCheck check = CheckOf({.offset = 0.1});
  EXPECT_EQ(check.lines.front().line_a, 1);
  EXPECT_NEAR(check.lines.front().mean, 0.1, 0.01);
  EXPECT_LT(check.lines.front().standard_error, 0.01);
}

TEST(CrossCheck, LeavesOutFewOutliersAndSaysSo) {
  std::vector<CrossPair> pairs = Pairs({});
  for (int i = 0; i < 30; ++i) pairs[static_cast<std::size_t>(i * 1000)].difference = 5;  // Fish.
  const CrossCheck check = CheckPairs(pairs).value();
  EXPECT_EQ(check.outliers, 30U);
  EXPECT_NEAR(check.chi_square, 1, 0.03);
}

TEST(CrossCheck, HasNoIntervalFromOnePlace) {
  std::vector<CrossPair> pairs = Pairs({.air = 2});
  for (CrossPair& pair : pairs) pair.line_a = 1, pair.line_b = 2, pair.x = 0;
  const CrossCheck check = CheckPairs(pairs).value();
  EXPECT_EQ(check.interval_units, "places");
  EXPECT_FALSE(check.factor.excludes(1));
  EXPECT_EQ(check.guilty, "");
  EXPECT_TRUE(CrossCheckJson(check)["factor"]["low"].is_null());
  EXPECT_THAT(CrossCheckText(check), ::testing::HasSubstr("gives no interval"));
}

TEST(CrossCheck, LeavesOutPlacesWhereLinesAreFew) {
  std::vector<CrossPair> pairs = Pairs({.air = 2});
  for (CrossPair& pair : pairs) pair.line_a = 1, pair.line_b = 2;
  const CrossCheck check = CheckPairs(pairs).value();
  EXPECT_EQ(check.interval_units, "places");
  EXPECT_EQ(check.guilty, "air");
  EXPECT_EQ(CheckOf({}).interval_units, "lines");
}

TEST(CrossCheck, NeedsPairs) {
  std::vector<CrossPair> none;
  EXPECT_FALSE(CheckPairs(none).has_value());
  std::vector<CrossPair> one = {Pairs({})[0]};
  const CrossCheck check = CheckPairs(one).value();
  EXPECT_EQ(check.pairs, 1U);
  EXPECT_TRUE(CrossCheckJson(check)["lines"][0]["standard_error"].is_null());
}

Patch TwoPlanes(double slope_x, double slope_y, double step) {
  Patch patch;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-2.5F, 2.5F);
  for (int i = 0; i < 40; ++i) {
    PatchPoint point{
        .x = place(random), .y = place(random), .variance_air = 0.01F, .line = static_cast<std::uint16_t>(i % 2)};
    point.z = static_cast<float>(-8 + slope_x * point.x + slope_y * point.y + (i % 2 == 0 ? step : 0));
    patch.points.push_back(point);
  }
  return patch;
}

TEST(CrossPairs, AreFreeOfTheSlope) {
  Patch patch = TwoPlanes(0.3, -0.2, 0.07);
  std::vector<CrossPair> pairs;
  AppendPairs(patch, pairs);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR(pairs[0].difference, 0.07, 1e-5);
  EXPECT_LT(pairs[0].distance, 0.5);
  EXPECT_NEAR(pairs[0].variance_air, 0.02, 1e-7);
}

// The variance of the height above a slope is g' C g with g = (-0.3, 0.2, 1): here of each point
// 0.01 + 0.09 0.04 + 0.04 0.02 + 2 (-0.06) 0.005 - 2 (0.3 0.004 - 0.2 0.003) = 0.0126.
TEST(CrossPairs, HaveTheVarianceAboveTheSlope) {
  Patch patch = TwoPlanes(0.3, -0.2, 0);
  for (PatchPoint& point : patch.points) {
    point.xx = 0.04F, point.yy = 0.02F, point.xy = 0.005F, point.xz = 0.004F, point.yz = 0.003F;
    point.sea_in_horizontal = 0.25F;
  }
  std::vector<CrossPair> pairs;
  AppendPairs(patch, pairs);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR(pairs[0].variance_air, 2 * (0.01 + 0.75 * 0.0026), 1e-6);
  EXPECT_NEAR(pairs[0].variance_sea, 2 * 0.25 * 0.0026, 1e-6);
  for (PatchPoint& point : patch.points) point.xz = 0.02F;  // Down the slope is too low: less than on a level bottom.
  pairs.clear();
  AppendPairs(patch, pairs);
  EXPECT_NEAR(pairs[0].variance(), 2 * (0.0126 - 2 * 0.3 * 0.016), 1e-6);
  EXPECT_EQ(pairs[0].variance_sea, 0);
}

TEST(CrossPairs, NeedTwoLinesAndASlope) {
  std::vector<CrossPair> pairs;
  Patch one = TwoPlanes(0, 0, 0);
  for (PatchPoint& point : one.points) point.line = 1;
  AppendPairs(one, pairs);
  Patch row = TwoPlanes(0, 0, 0);
  for (PatchPoint& point : row.points) point.y = point.x;  // All in one straight line.
  AppendPairs(row, pairs);
  EXPECT_TRUE(pairs.empty());
}

}  // namespace
}  // namespace albtpu::quality
