#include "quality/report/survey_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "quality/report/surface_nodes.h"
#include "tables/coverage.h"

namespace albtpu::quality {
namespace {

using ::testing::HasSubstr;

AnnotatedPoint RandomPoint(std::mt19937& random) {
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  AnnotatedPoint point;
  point.x = between(-200, 300);
  point.y = between(4'000'000, 4'000'090);
  point.has_number = between(0, 1) < 0.8;
  point.depth = static_cast<float>(between(0, 20));
  point.thu = static_cast<float>(between(0.2, 2));
  point.tvu = 2;
  point.variance_z = 1;
  point.tvu_air = static_cast<float>(between(0, 1));
  point.tvu_sea = static_cast<float>(between(0, 1));
  point.tvu_water = static_cast<float>(between(0, 1));
  point.tvu_extra = static_cast<float>(between(0, 0.5));
  return point;
}

// The slow twin: every point in a map.
TEST(SurveyGrid, HasTheMeansOfThePointsOfEachCell) {
  constexpr double kCell = 2.5;
  std::mt19937 random(3);
  std::map<std::pair<long, long>, std::vector<AnnotatedPoint>> twin;
  SurveyGrid grid(kCell, Coverage::kTwoSigma);
  std::uint32_t added = 0;
  for (int i = 0; i < 50'000; ++i) {
    const AnnotatedPoint point = RandomPoint(random);
    twin[{std::lround(std::floor(point.x / kCell)), std::lround(std::floor(point.y / kCell))}].push_back(point);
    grid.Add(point, static_cast<std::uint8_t>(1 + i % 5));
    ++added;
  }
  ASSERT_TRUE(grid.status().ok());
  std::uint32_t points = 0;
  std::size_t filled = 0;
  for (std::size_t strip = 0; strip < grid.rows() / SurveyGrid::kTile; ++strip) {
    std::vector<GridCell> cells;
    grid.Strip(strip, cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const GridCell& cell = cells[i];
      points += cell.points;
      if (cell.points == 0) continue;
      ++filled;
      const long column = static_cast<long>(grid.first_column() + static_cast<std::int64_t>(i % grid.columns()));
      const long row = static_cast<long>(grid.first_row() +
                                         static_cast<std::int64_t>(strip * SurveyGrid::kTile + i / grid.columns()));
      const std::vector<AnnotatedPoint>& of_cell = twin.at({column, row});
      ASSERT_EQ(cell.points, of_cell.size());
      double depth = 0, thu = 0, air = 0, datum = 0, count = 0;
      for (const AnnotatedPoint& point : of_cell) {
        if (!point.has_number) continue;
        ++count;
        depth += point.depth;
        thu += point.thu;
        air += std::pow(point.tvu_air / 2, 2);
        datum += 1 - (std::pow(point.tvu_air, 2) + std::pow(point.tvu_sea, 2) + std::pow(point.tvu_water, 2) +
                      std::pow(point.tvu_extra, 2)) /
                         4;
      }
      ASSERT_EQ(cell.with_number, count);
      if (count == 0) continue;
      EXPECT_NEAR(cell.depth, depth / count, 1e-5 * depth / count);
      EXPECT_NEAR(cell.thu, thu / count, 1e-6);
      EXPECT_NEAR(cell.shares[0], air / count, 1e-6);
      EXPECT_NEAR(cell.shares[3], datum / count, 1e-6);
    }
  }
  EXPECT_EQ(points, added);
  EXPECT_EQ(filled, twin.size());
}

// A float's steps at this height are 0.24 mm: a mean that runs in floats would not move by the late points.
TEST(SurveyGrid, HasTheMeanOfManyHighPoints) {
  constexpr int kPoints = 30'000;
  std::mt19937 random(4);
  std::normal_distribution<double> height(3770, 0.3);
  SurveyGrid grid(100, Coverage::kTwoSigma);
  AnnotatedPoint point;
  point.has_number = true;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    point.z = height(random) + 1.0 * i / kPoints;  // Along a slope.
    sum += point.z;
    grid.Add(point, 1);
  }
  std::vector<GridCell> cells;
  grid.Strip(0, cells);
  EXPECT_NEAR(cells[0].elevation, sum / kPoints, 3e-4);
}

TEST(Reach, IsExactForPercentages) {
  for (std::uint64_t part = 1; part < 1000; ++part) {
    const double percent = std::stod(std::to_string(part / 10) + "." + std::to_string(part % 10));
    for (const std::uint64_t times : {1U, 3U, 1'000'000U, 123'456'789U}) {
      EXPECT_TRUE(Reach(part * times, 1000 * times, percent)) << percent;
      EXPECT_FALSE(Reach(part * times - 1, 1000 * times, percent)) << percent;
    }
  }
}

TEST(SurveyGrid, KeepsTheLeastStrictOrderOfACell) {
  SurveyGrid grid(10, Coverage::kTwoSigma);
  AnnotatedPoint point;
  point.has_number = true;
  const auto worst = [&](std::vector<std::uint8_t> orders) {
    SurveyGrid cell(10, Coverage::kTwoSigma);
    for (const std::uint8_t order : orders) cell.Add(point, order);
    std::vector<GridCell> cells;
    cell.Strip(0, cells);
    return static_cast<int>(cells[0].worst_order);
  };
  EXPECT_EQ(worst({2, 4, 1}), 4);
  EXPECT_EQ(worst({2, 0, 1}), 6);  // A point meets none.
}

TEST(SurveyGrid, RefusesWhatIsTooLarge) {
  SurveyGrid lied(1, Coverage::kTwoSigma);
  AnnotatedPoint point;
  lied.Add(point, 1);
  point.x = point.y = 1e6;
  lied.Add(point, 1);
  EXPECT_EQ(lied.status().code(), absl::StatusCode::kResourceExhausted);
}

TEST(SurveyGrid, BoundsItsMemory) {
  SurveyGrid grid(1, Coverage::kTwoSigma);
  AnnotatedPoint point;
  for (int column = 0; column < 200 && grid.status().ok(); ++column)
    for (int row = 0; row < 200; ++row) {
      point.x = column * SurveyGrid::kTile;
      point.y = row * SurveyGrid::kTile;
      grid.Add(point, 1);
    }
  EXPECT_THAT(grid.status().message(), HasSubstr("MiB"));
}

AnnotatedPoint Point(double sigma_x, double sigma_y, double sigma_z, double depth) {
  AnnotatedPoint point;
  point.has_number = true;
  point.variance_x = static_cast<float>(sigma_x * sigma_x);
  point.variance_y = static_cast<float>(sigma_y * sigma_y);
  point.variance_z = static_cast<float>(sigma_z * sigma_z);
  point.thu = static_cast<float>(2 * std::hypot(sigma_x, sigma_y));
  point.tvu = static_cast<float>(2 * sigma_z);
  point.depth = static_cast<float>(depth);
  return point;
}

std::vector<Specification> Limits(std::optional<Limit> horizontal, std::optional<Limit> vertical,
                                  Coverage coverage = Coverage::kP95) {
  return {{.name = "own", .title = "", .source = "", .classes = {{"a", coverage, horizontal, vertical}}}};
}

bool Meets(const AnnotatedPoint& point, const std::vector<Specification>& limits) {
  return ClassJudge(limits).Met(point) == 1;
}

TEST(ClassJudge, HoldsTheVerticalAgainstTheLimitAtItsCoverage) {
  const AnnotatedPoint point = Point(0, 0, 0.1, 10);
  EXPECT_TRUE(Meets(point, Limits({}, Limit{0.1961})));
  EXPECT_FALSE(Meets(point, Limits({}, Limit{0.1959})));
  EXPECT_TRUE(Meets(point, Limits({}, Limit{0.1001}, Coverage::kOneSigma)));
  EXPECT_FALSE(Meets(point, Limits({}, Limit{0.1999}, Coverage::kTwoSigma)));
  // The limit grows with the depth.
  EXPECT_TRUE(Meets(point, Limits({}, Limit{0.1, 0.017, true})));   // 0.1972
  EXPECT_FALSE(Meets(point, Limits({}, Limit{0.1, 0.016, true})));  // 0.1887
  EXPECT_TRUE(Meets(point, Limits({}, Limit{0.1, 0.0097})));        // 0.197
}

// The radius that holds 95 %: 1.96 sigma in one dimension, 2.4477 sigma of a circle.
TEST(ClassJudge, TakesTheRadiusThatHoldsNinetyFivePerCent) {
  EXPECT_TRUE(Meets(Point(0.1, 0, 0, 10), Limits(Limit{0.1961}, {})));
  EXPECT_FALSE(Meets(Point(0.1, 0, 0, 10), Limits(Limit{0.1959}, {})));
  EXPECT_TRUE(Meets(Point(0.1, 0.1, 0, 10), Limits(Limit{0.2449}, {})));
  EXPECT_FALSE(Meets(Point(0.1, 0.1, 0, 10), Limits(Limit{0.2447}, {})));
  AnnotatedPoint turned = Point(0.1, 0.1, 0, 10);
  turned.covariance_xy = 0.01F;  // In one line, 45 degrees from the axes: sigma 0.1414.
  EXPECT_TRUE(Meets(turned, Limits(Limit{0.2773}, {})));
  EXPECT_FALSE(Meets(turned, Limits(Limit{0.2771}, {})));
}

TEST(ClassJudge, AddsTheMagnitudeOfTheBias) {
  AnnotatedPoint point = Point(0, 0, 0.1, 10);
  point.bias_vertical = -0.05F;
  EXPECT_TRUE(Meets(point, Limits({}, Limit{0.2461})));
  EXPECT_FALSE(Meets(point, Limits({}, Limit{0.2459})));
  point.bias_along_beam = 0.3F;
  EXPECT_FALSE(Meets(point, Limits(Limit{0.29}, Limit{1})));
  point.has_number = false;
  EXPECT_FALSE(Meets(point, Limits(Limit{10}, Limit{10})));
}

TEST(PointTally, AddsUpPointsWithAndWithoutANumber) {
  PointTally tally, other;
  AnnotatedPoint point = Point(0.1, 0.1, 0.2, 5);
  point.tvu_air = 0.2F;
  point.tvu_sea = 0.3F;
  tally.Add(point, 1, Coverage::kTwoSigma);
  tally.Add(point, 0, Coverage::kTwoSigma);
  other.Add({}, 0, Coverage::kTwoSigma);
  tally.Merge(other);
  const nlohmann::ordered_json json = tally.Json(2);
  EXPECT_EQ(json["points"], 3);
  EXPECT_EQ(json["with_number"], 2);
  EXPECT_EQ(json["meeting"], (std::vector<int>{1, 0}));
  EXPECT_NEAR(json["tvu"]["mean"].get<double>(), 0.4, 1e-6);
  EXPECT_NEAR(json["shares_vertical"]["air"].get<double>(), 0.01 / 0.04, 1e-6);
  EXPECT_NEAR(json["shares_vertical"]["sea"].get<double>(), 0.0225 / 0.04, 1e-6);
  EXPECT_NEAR(json["shares_vertical"]["datum"].get<double>(), 1 - 0.25 - 0.5625, 1e-6);
}

TEST(DepthTallies, MergeBinsIntoBands) {
  DepthTallies tallies;
  for (const double depth : {0.5, 1.5, 1.6, 7.0, 150.0}) tallies.Add(Point(0, 0, 0.1, depth), 0, Coverage::kTwoSigma);
  const nlohmann::ordered_json bins = tallies.Json(0), bands = tallies.Json(0, {2, 10});
  ASSERT_EQ(bins.size(), 4);
  EXPECT_EQ(bins[1]["points"], 2);
  EXPECT_TRUE(bins[3]["to"].is_null());
  ASSERT_EQ(bands.size(), 3);
  EXPECT_EQ(bands[0]["points"], 3);
  EXPECT_EQ(bands[1]["from"], 2);
  EXPECT_EQ(bands[1]["to"], 10);
  EXPECT_EQ(bands[2]["from"], 10);
}

}  // namespace
}  // namespace albtpu::quality
