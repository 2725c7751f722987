#include "sea/correlation/pairs_in_cell.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "sea/correlation/correlated_pulses.h"
#include "sea/spectra/described_sea.h"

namespace albtpu {
namespace {

TEST(PairsInCell, AtRandomPlacesAreThoseOfTheCellInTheMean) {
  constexpr int kPulses = 7, kDraws = 20'000;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> within(0, 1);
  std::array<double, kCellLevels> sum = {}, squares = {};
  for (int draw = 0; draw < kDraws; ++draw) {
    PairsInCell pairs;
    for (int i = 0; i < kPulses; ++i) {
      const double x = within(random);
      pairs.Add(x, within(random));
    }
    const std::array<double, kCellLevels> weights = pairs.Weights();
    double all = 0;
    for (std::size_t level = 0; level < weights.size(); ++level) {
      all += weights[level];
      sum[level] += weights[level] / kDraws, squares[level] += weights[level] * weights[level] / kDraws;
    }
    EXPECT_NEAR(all, kPulses * (kPulses - 1), 1e-9);
  }
  for (std::size_t level = 0; level < sum.size(); ++level) {
    const double standard_error = std::sqrt((squares[level] - sum[level] * sum[level]) / kDraws);
    EXPECT_NEAR(sum[level], level == 0 ? kPulses * (kPulses - 1) : 0, 4 * standard_error) << level;
  }
}

TEST(PairsInCell, InItsQuartersShareLess) {
  PairsInCell pairs;
  for (const double x : {0.2, 0.8})
    for (const double y : {0.3, 0.7}) pairs.Add(x, y);
  // 12 pairs of (4 C_0 - C_1) / 3.
  const std::array<double, kCellLevels> weights = pairs.Weights();
  EXPECT_NEAR(weights[0], 16, 1e-12);
  EXPECT_NEAR(weights[1], -4, 1e-12);
  EXPECT_NEAR(weights[2], 0, 1e-12);
}

TEST(PairsInCell, InOnePartShareMore) {
  PairsInCell pairs;
  for (int i = 0; i < 3; ++i) pairs.Add(0.1 * i, 0.99);
  pairs.Add(0.99, 0.1);
  const std::array<double, kCellLevels> weights = pairs.Weights();
  // Three pairs with the one on the other side. Of the others, that of 0 and 0.1 is in one part.
  EXPECT_NEAR(weights[0], 6 * 4.0 / 3, 1e-12);
  EXPECT_NEAR(weights[1] + weights[2], 6 - 6 / 3.0, 1e-12);
  EXPECT_GT(weights[2], 0);
}

TEST(PairsInCell, SeeACircleAsTheSquareOfItsArea) {
  const double diagonal = std::sqrt(0.5);
  EXPECT_NEAR((SquareOfCircle({1, 0}) - Eigen::Vector2d(1, 0.5)).norm(), 0, 1e-12);
  EXPECT_NEAR((SquareOfCircle({-diagonal, diagonal}) - Eigen::Vector2d(0, 1)).norm(), 0, 1e-12);
  EXPECT_NEAR((SquareOfCircle({0, -0.5}) - Eigen::Vector2d(0.5, 0.25)).norm(), 0, 1e-12);
  EXPECT_NEAR((SquareOfCircle({0, 0}) - Eigen::Vector2d(0.5, 0.5)).norm(), 0, 1e-12);
  // Points that lie evenly in one lie evenly in the other, 1 of 16 in each part.
  constexpr int kAlong = 1000;
  std::array<double, 16> parts = {};
  for (int i = 0; i < kAlong; ++i)
    for (int j = 0; j < kAlong; ++j) {
      const Eigen::Vector2d at = Eigen::Vector2d(i + 0.5, j + 0.5) * (2.0 / kAlong) - Eigen::Vector2d(1, 1);
      if (at.norm() >= 1) continue;
      const Eigen::Vector2d square = SquareOfCircle(at) * 4;
      ++parts[static_cast<std::size_t>(square.y()) * 4 + static_cast<std::size_t>(square.x())];
    }
  for (const double part : parts) EXPECT_NEAR(part / (kAlong * kAlong * std::numbers::pi / 4), 1.0 / 16, 1e-4);
}

// Pulses of a scan, whose lines begin anywhere, against the sum of the covariances of all pairs. To take them for
// pulses at random places is wrong by more than twice as much.
TEST(PairsInCell, OfAScanAreTheSumOverItsPairs) {
  const DescribedSea sea = Describe({.wind_speed_10m = 6, .wind_from = 0});
  constexpr double kSide = 2;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> within(0, 1);
  for (const double incidence : {0.0, 0.35}) {
    const CorrelatedPulses pulses(sea.spectrum, {.incidence = incidence, .azimuth = 0.4, .footprint = 0.6});
    std::array<double, kCellLevels> cells;
    for (int level = 0; level < kCellLevels; ++level)
      cells[static_cast<std::size_t>(level)] = pulses.InCell({.side = std::ldexp(kSide, -level)}).vertical;
    for (const double spacing : {1.0, 0.5}) {
      constexpr int kDraws = 12;
      double exact = 0, ours = 0, anywhere = 0;
      for (int draw = 0; draw < kDraws; ++draw) {
        const double first_x = within(random) * spacing, first_y = within(random) * spacing;
        std::vector<std::array<double, 2>> places;
        PairsInCell pairs;
        for (double x = first_x; x < kSide; x += spacing)
          for (double y = first_y; y < kSide; y += spacing) {
            places.push_back({x, y});
            pairs.Add(x / kSide, y / kSide);
          }
        const auto n = static_cast<double>(places.size());
        const auto add = [n](double pairs_sum, double& to) { to += (n + pairs_sum) / (n * n) / kDraws; };
        double sum = 0;
        for (std::size_t i = 0; i < places.size(); ++i)
          for (std::size_t j = 0; j < i; ++j)
            sum += 2 * pulses.Between(places[i][0] - places[j][0], places[i][1] - places[j][1], 0).vertical;
        add(sum, exact);
        add(n * (n - 1) * cells[0], anywhere);
        double of_levels = 0;
        for (std::size_t level = 0; level < cells.size(); ++level) of_levels += pairs.Weights()[level] * cells[level];
        add(of_levels, ours);
      }
      EXPECT_NEAR(ours / exact, 1, 0.04) << spacing << " m, " << incidence;
      EXPECT_GT(anywhere / exact, 1 + 2 * std::abs(ours / exact - 1) + 0.015) << spacing << " m, " << incidence;
    }
  }
}

}  // namespace
}  // namespace albtpu
