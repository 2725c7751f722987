#include "quality/report/bottom_coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <vector>

namespace albtpu::quality {
namespace {

using Cell = std::pair<int, int>;  // Column, row.

AnnotatedPoint PointIn(const Cell& cell, double side) {
  AnnotatedPoint point;
  point.x = (cell.first + 0.5) * side;
  point.y = (cell.second + 0.5) * side;
  return point;
}

BottomCoverage CoverageOf(const std::map<Cell, int>& points, const std::set<Cell>& land, double side) {
  SurveyGrid grid(side, Coverage::kTwoSigma);
  LandCells dry(side);
  for (const auto& [cell, count] : points)
    for (int i = 0; i < count; ++i) grid.Add(PointIn(cell, side), 0);
  for (const auto& cell : land) dry.Add({.point = {.x = (cell.first + 0.5) * side, .y = (cell.second + 0.5) * side}});
  return BottomCoverage::Of(grid, dry, 1);
}

// The slow twin: every empty cell of the surveyed area is looked up, and voids grow from cell to cell.
struct Twin {
  std::set<Cell> empty;
  std::vector<std::set<Cell>> voids;

  Twin(const std::map<Cell, int>& points, const std::set<Cell>& land) {
    for (int column = -100; column < 100; ++column)
      for (int row = -100; row < 100; ++row) {
        if (points.contains({column, row}) || land.contains({column, row})) continue;
        bool west = false, east = false, south = false, north = false;
        for (const auto& [cell, count] : points) {
          west = west || (cell.second == row && cell.first < column);
          east = east || (cell.second == row && cell.first > column);
          south = south || (cell.first == column && cell.second < row);
          north = north || (cell.first == column && cell.second > row);
        }
        if (west && east && south && north) empty.insert({column, row});
      }
    std::set<Cell> left = empty;
    while (!left.empty()) {
      std::set<Cell> found;
      std::vector<Cell> next = {*left.begin()};
      while (!next.empty()) {
        const Cell cell = next.back();
        next.pop_back();
        if (left.erase(cell) == 0) continue;
        found.insert(cell);
        const auto [column, row] = cell;
        for (const Cell& beside : {Cell{column - 1, row}, {column + 1, row}, {column, row - 1}, {column, row + 1}})
          next.push_back(beside);
      }
      voids.push_back(found);
    }
  }
};

TEST(BottomCoverage, FindsTheVoidsOfItsSlowTwin) {
  constexpr double kSide = 2;
  std::mt19937 random(5);
  for (const double density : {0.3, 0.6, 0.95}) {
    std::map<Cell, int> points;
    std::set<Cell> land;
    std::uint64_t count = 0;
    const auto chance = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
    for (int column = -20; column < 30; ++column)
      for (int row = -5; row < 25; ++row) {
        const bool in_survey = std::hypot(column - 5, row - 10) < 17;
        if (in_survey && chance() < density) count += points[{column, row}] = 1 + static_cast<int>(4 * chance());
        if (!points.contains({column, row}) && chance() < 0.02) land.insert({column, row});
      }
    const Twin twin(points, land);
    const BottomCoverage coverage = CoverageOf(points, land, kSide);
    EXPECT_EQ(coverage.points, count);
    EXPECT_EQ(coverage.covered, points.size());
    EXPECT_EQ(coverage.cells, points.size() + twin.empty.size());
    EXPECT_EQ(coverage.voids, twin.voids.size());
    std::size_t largest = 0, large = 0;
    for (const auto& each : twin.voids) {
      largest = std::max(largest, each.size());
      large += static_cast<double>(each.size()) * kSide * kSide >= std::pow(4 * coverage.spacing(), 2) ? 1 : 0;
    }
    EXPECT_EQ(coverage.largest.cells, largest);
    EXPECT_EQ(coverage.large_voids, large);
    const Cell at = {static_cast<int>(std::floor(coverage.largest.x / kSide)),
                     static_cast<int>(std::floor(coverage.largest.y / kSide))};
    bool in_largest = false;
    for (const auto& each : twin.voids) in_largest = in_largest || (each.size() == largest && each.contains(at));
    EXPECT_TRUE(in_largest) << at.first << ", " << at.second;
    EXPECT_NEAR(coverage.spacing(), std::sqrt(coverage.area() / static_cast<double>(count)), 1e-12);
  }
}

TEST(BottomCoverage, HasNoVoidWhereEveryCellHasBottomOrLand) {
  std::map<Cell, int> points;
  for (int column = 0; column < 70; ++column)
    for (int row = 0; row < 3; ++row) points[{column, row}] = 2;
  points.erase({65, 1});
  const BottomCoverage coverage = CoverageOf(points, {{65, 1}}, 1);
  EXPECT_EQ(coverage.voids, 0);
  EXPECT_EQ(coverage.cells, points.size());
  EXPECT_EQ(coverage.median, 2);
  EXPECT_DOUBLE_EQ(coverage.density(), 2);
  EXPECT_TRUE(coverage.Json()["largest_void"].is_null());
  EXPECT_EQ(CoverageOf(points, {}, 1).largest.cells, 1);
}

}  // namespace
}  // namespace albtpu::quality
