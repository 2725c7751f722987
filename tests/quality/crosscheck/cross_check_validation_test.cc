// The cross-check of surveys whose errors are known: simulated by the exact model, predicted by the budget. The sea is
// drawn anew for each pulse; that it is shared is in blocks_validation_test.cc.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "quality/crosscheck/cross_check.h"
#include "quality/crosscheck/overlap_patches.h"
#include "tests/quality/crosscheck/simulated_lines.h"

namespace albtpu::quality {
namespace {

using testing::SimulatedLines;

// ALBTPU_CROSS_CHECK_SEEDS=100 measures more precisely how often the intervals hold the truth.
const int kSeeds = [] {
  const char* const seeds = std::getenv("ALBTPU_CROSS_CHECK_SEEDS");
  return seeds != nullptr ? std::max(std::atoi(seeds), 20) : 20;
}();

CrossCheck CheckPoints(const std::vector<AnnotatedPoint>& points) {
  OverlapPatches patches(5, 1, Coverage::kOneSigma);
  patches.Find(points);
  patches.Choose();
  patches.Fill(points, PulseOnWater::kNoSea);  // Slopes are drawn anew for each pulse.
  return CheckPatches(patches, SharedWaves()).value();
}

CrossCheck CheckOf(const SimulatedLines& options) { return CheckPoints(testing::Simulate(options)); }

TEST(CrossCheckOfSimulatedSurveys, FindsThatARightPredictionIsRight) {
  double sum = 0;
  int covered = 0, covered_lines = 0, accused = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const CrossCheck check = CheckOf({.seed = static_cast<std::uint64_t>(seed)});
    sum += check.chi_square;
    covered += check.pulse.factor.excludes(1) ? 0 : 1;
    covered_lines += check.line.factor->excludes(1) ? 0 : 1;
    accused += check.guilty.empty() ? 0 : 1;
  }
  std::cout << "chi-square, mean of " << kSeeds << " surveys: " << sum / kSeeds << "; the interval of pulses has 1 in "
            << covered << ", of lines in " << covered_lines << ", a part differs in " << accused << "\n";
  EXPECT_NEAR(sum / kSeeds, 1, 0.05);
  EXPECT_GE(covered_lines, 0.85 * kSeeds);
  EXPECT_GE(covered, 0.85 * kSeeds);  // 17 of 20: less has a probability of 1.6 % where 95 % do.
  EXPECT_LE(accused, 0.05 * kSeeds);
}

// On ridges whose slope is 12 % (root mean square), a point that lies too far along is too high or too low.
TEST(CrossCheckOfSimulatedSurveys, CountsTheHorizontalErrorsOnASlope) {
  double sum = 0, sum_without = 0;
  int accused = 0;
  constexpr int kSlopes = 6;
  for (int seed = 1; seed <= kSlopes; ++seed) {
    std::vector<AnnotatedPoint> points =
        testing::Simulate({.seed = static_cast<std::uint64_t>(seed), .bottom_slope = 0.12});
    const CrossCheck check = CheckPoints(points);
    sum += check.chi_square / kSlopes;
    accused += check.guilty.empty() ? 0 : 1;
    for (AnnotatedPoint& point : points)
      point.variance_x = point.variance_y = point.covariance_xy = point.covariance_xz = point.covariance_yz = 0;
    sum_without += CheckPoints(points).chi_square / kSlopes;
  }
  std::cout << "chi-square on slopes, mean of " << kSlopes << " surveys: " << sum
            << "; if horizontal errors did not count: " << sum_without << "\n";
  EXPECT_NEAR(sum, 1, 0.15);  // Three standard deviations: few lines make that of a survey scatter by 0.12.
  EXPECT_GT(sum_without, sum + 0.08);
  EXPECT_EQ(accused, 0);
}

TEST(CrossCheckOfSimulatedSurveys, FindsAnAirSideDeclaredHalfAsLarge) {
  double sum = 0, of_lines = 0;
  int pulses_noticed = 0, lines_noticed = 0;
  const int surveys = kSeeds / 2;
  for (int seed = 1; seed <= surveys; ++seed) {
    const CrossCheck check = CheckOf({.seed = static_cast<std::uint64_t>(seed), .declared = 0.5});
    sum += check.pulse.air.value;
    of_lines += check.line.factor->value;
    pulses_noticed += check.pulse.factor.excludes(1) && check.pulse.factor.value > 1 ? 1 : 0;
    lines_noticed += check.line.factor->excludes(1) ? 1 : 0;
    EXPECT_GT(check.chi_square, 1.3) << seed;
  }
  std::cout << "factors of the air side, mean of " << surveys << " surveys: " << sum / surveys << ", of lines "
            << of_lines / surveys << "; noticed of pulses in " << pulses_noticed << ", of lines in " << lines_noticed
            << "\n";
  EXPECT_NEAR(sum / surveys, 2, 0.1);
  EXPECT_NEAR(of_lines / surveys, 2, 0.36);  // Three standard deviations: 15 lines know a factor to a fifth.
  EXPECT_EQ(lines_noticed, surveys);         // The air side is a small part of pulses, which the sea dominates.
}

TEST(CrossCheckOfSimulatedSurveys, FindsAnAirSideDeclaredHalfAsLargeWhereNothingElseErrs) {
  const CrossCheck check = CheckOf({.wave_slope = 0.001, .declared = 0.5});
  EXPECT_FALSE(check.line.factor->excludes(2));
  EXPECT_EQ(check.guilty, "trajectory");
  EXPECT_NEAR(check.pulse.factor.value, 2, 0.1);
}

TEST(CrossCheckOfSimulatedSurveys, IsNotMisledByARoughBottom) {
  const CrossCheck check = CheckOf({.bottom_waves = 0.05});
  EXPECT_NEAR(check.chi_square, 1, 0.15);
}

// Errors that are not normal and that no prediction has. Lines flown in one direction disagree by an offset; of lines
// flown to and fro, both sides of an overlap are too high or both too low, and only the cross lines show it.
TEST(CrossCheckOfSimulatedSurveys, ReportsABoresightThatNobodyKnows) {
  const auto check_of = [](bool to_and_fro, int seed) {
    const CrossCheck check =
        CheckOf({.seed = static_cast<std::uint64_t>(seed), .to_and_fro = to_and_fro, .roll_of_scanner = 0.05});
    std::cout << "roll of the scanner wrong by 0.05 degree, " << (to_and_fro ? "to and fro" : "in one direction")
              << ": chi-square " << check.chi_square << ", without the means of lines " << check.chi_square_within_lines
              << ", factor " << check.factor.value << " (" << check.factor.low << " to " << check.factor.high
              << "), accused: " << check.guilty << ", largest difference of lines "
              << check.line.differences.front().mean << " +- " << check.line.differences.front().standard_error
              << " m\n";
    return check;
  };
  const CrossCheck one_way = check_of(false, 1);
  EXPECT_EQ(one_way.guilty, "trajectory");
  EXPECT_LT(one_way.chi_square_within_lines, 0.5 * one_way.chi_square);
  EXPECT_GT(std::abs(one_way.line.differences.front().mean), 5 * one_way.line.differences.front().standard_error);
  double both_ways = 0;
  constexpr int kBothWays = 4;
  for (int seed = 1; seed <= kBothWays; ++seed) both_ways += check_of(true, seed).chi_square / kBothWays;
  EXPECT_GT(both_ways, 1.13);  // Four standard deviations of the mean of four surveys that are right.
  EXPECT_LT(both_ways, one_way.chi_square);
}

}  // namespace
}  // namespace albtpu::quality
