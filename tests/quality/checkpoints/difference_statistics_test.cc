// The statistics of differences: closed forms, and differences that are drawn as they are predicted.
#include "quality/checkpoints/difference_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace albtpu::quality {
namespace {

std::vector<std::size_t> AllOf(const std::vector<Difference>& differences) {
  std::vector<std::size_t> all(differences.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

DifferenceStatistics OfAll(const std::vector<Difference>& differences) {
  return StatisticsOf(differences, AllOf(differences));
}

// 0.03, -0.01, 0.02, -0.04: independent, as large as 0.02 m.
std::vector<Difference> FourIndependent() {
  std::vector<Difference> four;
  for (const double d : {0.03, -0.01, 0.02, -0.04}) four.push_back({.difference = d, .own = 4e-4, .tvu = 0.035});
  return four;
}

TEST(DifferenceStatistics, OfIndependentPointsAreTheUsualOnes) {
  std::vector<Difference> four = FourIndependent();
  for (Difference& each : four) each.point_sigma = 0.01;
  const DifferenceStatistics of = OfAll(four);
  EXPECT_NEAR(of.mean.value, 0, 1e-15);
  EXPECT_NEAR(of.deviation, std::sqrt(0.003 / 3), 1e-12);
  EXPECT_NEAR(of.rmse.value, std::sqrt(0.003 / 4), 1e-12);
  EXPECT_NEAR(of.rmse_total(), std::sqrt(0.003 / 4 + 1e-4), 1e-12);
  EXPECT_NEAR(of.squared_z.value, 0.003 / 4 / 4e-4, 1e-12);
  EXPECT_NEAR(of.squared_z_degrees, 4, 1e-12);
  EXPECT_NEAR(of.rmse_degrees, 4, 1e-12);
  // Chi-square of 4 degrees of freedom: 0.484419 and 11.143287 (Abramowitz and Stegun, table 26.8).
  EXPECT_NEAR(of.rmse.low, std::sqrt(0.003 / 11.143287), 1e-7);
  EXPECT_NEAR(of.rmse.high, std::sqrt(0.003 / 0.484419), 1e-6);
  // About the mean, of 3 degrees: E = 3 * 4e-4.
  EXPECT_NEAR(of.scatter.value, std::sqrt(0.003 / 12e-4), 1e-12);
  EXPECT_NEAR(of.standard_error, std::sqrt(0.003 / 3 / 4), 1e-12);
  // The sizes 0.01, 0.02, 0.03, 0.04; 0.95 of the way is 0.85 of the last step.
  EXPECT_NEAR(of.percentile95, 0.0385, 1e-12);
  EXPECT_EQ(of.within_tvu, 0.75);
  EXPECT_EQ(of.within_predicted, 0.75);
  EXPECT_FALSE(of.has_offset);
}

TEST(DifferenceStatistics, OfOnlyCommonErrorsHaveOneDegreeOfFreedom) {
  std::vector<Difference> same(10, {.difference = 0.05, .survey = 0.05});
  for (Difference& each : same) each.own = 1e-12;
  EXPECT_NEAR(OfAll(same).squared_z_degrees, 1, 1e-6);
  EXPECT_NEAR(OfAll(same).squared_z.value, 1, 1e-6);
  // What all points share is an offset, which it explains.
  EXPECT_TRUE(OfAll(same).has_offset);
  EXPECT_NEAR(OfAll(same).offset_z(), 1, 1e-6);
  // Two halves of 10 points, each of one line: two degrees.
  for (std::size_t i = 0; i < same.size(); ++i) {
    same[i].survey = 0;
    same[i].lines = {{static_cast<std::uint16_t>(i % 2), 0.05}};
  }
  EXPECT_NEAR(OfAll(same).squared_z_degrees, 2, 1e-6);
  EXPECT_NEAR(OfAll(same).standard_error, 0.05 / std::sqrt(2), 1e-6);
  EXPECT_FALSE(OfAll(same).has_offset);
}

// One line of variance L and own variances P: var(mean) = L + P / n, and about the mean only P counts.
TEST(DifferenceStatistics, OfOneLineTakeItForTheMeanAndNotForTheScatter) {
  std::vector<Difference> four = FourIndependent();
  for (Difference& each : four) each.lines = {{7, 0.03}};
  const DifferenceStatistics of = OfAll(four);
  EXPECT_NEAR(of.scatter.value, std::sqrt(0.003 / 12e-4), 1e-12);
  EXPECT_NEAR(of.predicted_by_lines, 0.03, 1e-12);
  EXPECT_NEAR(of.standard_error, std::sqrt(0.003 / 12e-4 * (9e-4 + 1e-4)), 1e-12);
}

TEST(DifferenceStatistics, TakeThePredictedBiasAwayWhereTheyTest) {
  std::vector<Difference> four = FourIndependent();
  for (Difference& each : four) each.difference += 0.5, each.bias = 0.5;
  const DifferenceStatistics of = OfAll(four);
  EXPECT_NEAR(of.mean.value, 0.5, 1e-12);
  EXPECT_NEAR(of.offset(), 0, 1e-12);
  EXPECT_NEAR(of.squared_z.value, 0.003 / 4 / 4e-4, 1e-9);
  EXPECT_FALSE(of.has_offset);
}

TEST(DifferenceStatistics, OfPointsThatShareTheirLidarPointsAreFewer) {
  std::vector<Difference> two(2, {.difference = 0.01, .own = 1e-4});
  two[0].same_points = {{1, 1e-4}};
  EXPECT_NEAR(OfAll(two).squared_z_degrees, 1, 1e-9);
  EXPECT_EQ(StatisticsOf(two, std::vector<std::size_t>{1}).points, 1U);
}

// Differences drawn as predicted: 40 points of 5 lines, each seen by one or two of them.
class DrawnDifferences {
 public:
  explicit DrawnDifferences(unsigned seed) : random_(seed) {}

  std::vector<Difference> Draw(double survey, double drawn_offset, double scale = 1) {
    std::vector<double> lines(5);
    for (double& line : lines) line = normal_(random_);
    const double common = drawn_offset + survey * normal_(random_);
    std::vector<Difference> drawn;
    for (std::size_t i = 0; i < 40; ++i) {
      Difference d{.own = std::pow(0.02 + 0.001 * static_cast<double>(i % 10), 2), .survey = survey};
      const std::size_t line = i / 8;
      d.lines = {{static_cast<std::uint16_t>(line), 0.03}};
      if (i % 2 == 0 && line < 4)
        d.lines = {{static_cast<std::uint16_t>(line), 0.015}, {static_cast<std::uint16_t>(line + 1), 0.015}};
      d.difference = common + scale * std::sqrt(d.own) * normal_(random_);
      for (const auto& [number, sigma] : d.lines) d.difference += scale * sigma * lines[number];
      drawn.push_back(d);
    }
    return drawn;
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

constexpr int kRealizations = 1000;

TEST(DifferenceStatistics, HoldTheirIntervals) {
  DrawnDifferences drawn(1);
  double squared_z = 0, in_z = 0, in_rmse = 0, in_mean = 0, offsets = 0, differs = 0, in_scatter = 0;
  for (int i = 0; i < kRealizations; ++i) {
    constexpr double kOffset = 0.02;  // Drawn once for all: what the survey has.
    const DifferenceStatistics of = OfAll(drawn.Draw(0.04, 0));
    squared_z += of.squared_z.value / kRealizations;
    in_z += !of.squared_z.excludes(1);
    in_scatter += !of.scatter.excludes(1);
    differs += of.scatter_differs;
    const std::vector<Difference> with = drawn.Draw(0, kOffset);
    const DifferenceStatistics fixed = OfAll(with);
    double truth = kOffset * kOffset;
    for (const Difference& each : with) truth += each.variance() / 40;
    in_rmse += !fixed.rmse.excludes(std::sqrt(truth));
    in_mean += !fixed.mean.excludes(kOffset);
    offsets += OfAll(drawn.Draw(0, 0)).has_offset;
  }
  std::printf(
      "mean z^2 %.3f; of %d: its interval holds 1 in %.0f, that of RMSE the truth in %.0f, of the mean in %.0f, "
      "of the scatter in %.0f; scatter differs in %.0f, an offset is named in %.0f\n",
      squared_z, kRealizations, in_z, in_rmse, in_mean, in_scatter, differs, offsets);
  // The variance of z^2 of one realization is at most 2; three binomial standard errors of 95 % are 2.1 %.
  EXPECT_NEAR(squared_z, 1, 3 * std::sqrt(2.0 / kRealizations));
  EXPECT_NEAR(in_rmse / kRealizations, 0.95, 0.03);
  EXPECT_NEAR(in_scatter / kRealizations, 0.95, 0.03);
  EXPECT_GT(in_z / kRealizations, 0.93);
  EXPECT_GT(in_mean / kRealizations, 0.93);
  EXPECT_LT(offsets / kRealizations, 0.02);
  EXPECT_LT(differs / kRealizations, 0.015);
}

TEST(DifferenceStatistics, FindAnOffsetAndAnotherScatter) {
  DrawnDifferences drawn(2);
  int offsets = 0, differs = 0;
  for (int i = 0; i < 100; ++i) {
    offsets += OfAll(drawn.Draw(0, 0.1)).has_offset;
    differs += OfAll(drawn.Draw(0, 0, 3)).scatter_differs;
  }
  EXPECT_GE(offsets, 95);
  EXPECT_GE(differs, 95);
}

}  // namespace
}  // namespace albtpu::quality
