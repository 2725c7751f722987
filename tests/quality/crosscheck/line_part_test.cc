// The part of lines: closed forms, and what is found where errors are drawn as they are said to be.
#include "quality/crosscheck/line_part.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "quality/crosscheck/pair_groups.h"
#include "quality/crosscheck/pulse_part.h"

namespace albtpu::quality {
namespace {

// Places of lines with the variance 1 each, of overlaps that are pairs of lines.
PairGroups Groups(const std::vector<std::pair<int, int>>& overlaps, int places, double noise,
                  const std::function<double(int, int, int)>& mean) {
  PairGroups groups;
  for (const auto& [a, b] : overlaps)
    for (int i = 0; i < places; ++i)
      groups.places.push_back({.line_a = static_cast<std::uint16_t>(a),
                               .line_b = static_cast<std::uint16_t>(b),
                               .pairs = {0},
                               .mean = mean(a, b, i),
                               .noise = noise,
                               .line_a_variance = 1,
                               .line_b_variance = 1,
                               .line_product = 1});
  return groups;
}

// The overlaps of 6 lines, each with the next one, and of 2 cross lines.
std::vector<std::pair<int, int>> Block() {
  std::vector<std::pair<int, int>> block = {{1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}};
  for (int line = 1; line <= 6; ++line) block.emplace_back(line, 7), block.emplace_back(line, 8);
  return block;
}

// Offsets of lines make differences whose sum of squares is a quadratic form with the Laplacian of the graph of
// overlaps: its degrees of freedom are the square of the sum of its eigenvalues over the sum of their squares.
TEST(LinePart, HasTheDegreesOfFreedomOfItsOverlaps) {
  const auto of_lines = [](int a, int b, int) { return 1.0 * a - b; };
  EXPECT_NEAR(TestLines(Groups({{1, 2}}, 5, 0, of_lines)).degrees, 1, 1e-9);
  EXPECT_NEAR(TestLines(Groups({{1, 2}, {2, 3}, {1, 3}}, 5, 0, of_lines)).degrees, 2, 1e-9);
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(9, 9);
  for (const auto& [a, b] : Block()) ++laplacian(a, a), ++laplacian(b, b), --laplacian(a, b), --laplacian(b, a);
  EXPECT_NEAR(TestLines(Groups(Block(), 4, 0, of_lines)).degrees,
              std::pow(laplacian.trace(), 2) / (laplacian * laplacian).trace(), 1e-9);
  // Errors that do not last: as many as there are places.
  const auto apart = [](int, int, int place) { return place % 2 == 0 ? 1.0 : -1.0; };
  EXPECT_NEAR(TestLines(Groups({{1, 2}}, 10, 0, apart)).degrees, 10, 1e-9);
}

// Some places are known better than others. The correlation with which errors were drawn is found all the same.
TEST(LinePart, KnowsHowLongErrorsLastWhereNoiseDiffers) {
  constexpr double kNoises[] = {0, 0.2, 4, 40};  // m^2, beside a variance of both lines of 2 m^2.
  std::vector<std::pair<int, int>> overlaps;
  for (int i = 0; i < 4000; ++i) overlaps.emplace_back(2 * i, 2 * i + 1);
  for (const double lasting : {0.0, 0.5, 1.0}) {
    std::mt19937_64 generator(3);
    std::normal_distribution<double> normal;
    double constant = 0;
    PairGroups groups = Groups(overlaps, 4, 0, [&](int, int, int place) {
      if (place == 0) constant = std::sqrt(2 * lasting) * normal(generator);
      return constant + std::sqrt(2 * (1 - lasting)) * normal(generator);
    });
    for (std::size_t i = 0; i < groups.places.size(); ++i) {
      groups.places[i].noise = kNoises[i % 4];
      groups.places[i].mean += std::sqrt(kNoises[i % 4]) * normal(generator);
    }
    EXPECT_NEAR(TestLines(groups).lasting, lasting, 0.05);
  }
}

// Two lines without predicted errors say nothing of how long those of others last.
TEST(LinePart, LeavesOutLinesWithoutPredictedErrors) {
  PairGroups groups = Groups({{1, 2}, {3, 4}}, 3, 1, [](int, int, int) { return 2.0; });
  for (PairGroup& place : groups.places)
    if (place.line_a == 1) place.line_a_variance = place.line_b_variance = place.line_product = 0;
  EXPECT_EQ(TestLines(groups).lasting, TestLines(Groups({{3, 4}}, 3, 1, [](int, int, int) { return 2.0; })).lasting);
}

// Of two lines that differ by d, d^2 / 2 is chi-square of one degree of freedom.
TEST(LinePart, HasTheIntervalOfChiSquare) {
  const LinePart part = TestLines(Groups({{1, 2}}, 5, 0, [](int, int, int) { return 3.0; }));
  EXPECT_NEAR(part.factor->value, std::sqrt(4.5), 1e-9);
  EXPECT_NEAR(part.factor->low, std::sqrt(4.5 / 5.02389), 1e-5);
  EXPECT_NEAR(part.factor->high, std::sqrt(4.5 / 0.000982069), 1e-3);
  // Where the noise explains all, lines may have no errors.
  const LinePart noisy = TestLines(Groups({{1, 2}}, 5, 9, [](int, int, int) { return 3.0; }));
  EXPECT_EQ(noisy.factor->value, 0);
  EXPECT_EQ(noisy.factor->low, 0);
}

// A part of each line's error, with the share `changing` of its variance, is drawn anew in each place.
TEST(LinePart, FlagsAsOftenAsItSays) {
  constexpr int kDraws = 500, kPlaces = 8;
  constexpr double kNoise = 0.3;
  const auto at_most = [](double rate) { return kDraws * rate + 3 * std::sqrt(kDraws * rate * (1 - rate)); };
  EXPECT_DOUBLE_EQ(kTailOfLarger + kTailOfSmaller, 2 * kTailOfPart);
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  for (const auto& [changing, noticed] : {std::pair{0.0, 0.9}, {0.1, 0.99}, {0.5, 1.0}}) {
    int not_held = 0, wrong = 0, right = 0;
    for (int draw = 0; draw < kDraws; ++draw)
      for (const double factor : {1.0, 3.0}) {
        std::map<int, double> constant;
        for (int line = 1; line <= 8; ++line) constant[line] = factor * std::sqrt(1 - changing) * normal(generator);
        const double other = std::sqrt(2 * factor * factor * changing + kNoise);
        const LinePart part = TestLines(Groups(Block(), kPlaces, kNoise, [&](int a, int b, int) {
          return constant[a] - constant[b] + other * normal(generator);
        }));
        if (factor == 1) not_held += part.factor->excludes(1) ? 1 : 0;
        (factor == 1 ? wrong : right) += part.differs ? 1 : 0;
      }
    EXPECT_LE(not_held, at_most(0.05)) << changing;
    EXPECT_LE(wrong, at_most(kTailOfLarger + kTailOfSmaller)) << changing;
    EXPECT_GE(right, noticed * kDraws) << changing;
  }
}

}  // namespace
}  // namespace albtpu::quality
