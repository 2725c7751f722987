#include "budget/beams/terrain_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace albtpu {
namespace {

using Point = std::array<double, 3>;

double HeightAt(double x, double y) { return 3 + 0.3 * x - 0.2 * y; }

// Over 40 m by 40 m, some of them across the axes of the frame, with heights that scatter by `sigma`.
std::vector<Point> Slope(int count, double sigma, std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(-20, 20);
  std::normal_distribution<double> error;
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const double x = place(random), y = place(random);
    points.push_back({x, y, HeightAt(x, y) + sigma * error(random)});
  }
  return points;
}

TerrainPlanes PlanesOf(const std::vector<Point>& points) {
  TerrainReturns returns;
  for (const Point& each : points) returns.Add(each[0], each[1], each[2]);
  return returns.Finish();
}

TEST(TerrainPlanes, AreExactOnAPlane) {
  std::mt19937_64 random(1);
  const TerrainPlanes planes = PlanesOf(Slope(6000, 0, random));
  EXPECT_EQ(planes.cell(), 2);
  for (const double x : {-19.0, -0.1, 0.1, 15.0}) {
    for (const double y : {-18.0, 0.0, 19.5}) {
      const auto gradient = planes.GradientAt(x, y);
      ASSERT_TRUE(gradient.has_value());
      EXPECT_NEAR(gradient->x, 0.3, 1e-5);
      EXPECT_NEAR(gradient->y, -0.2, 1e-5);
    }
  }
  EXPECT_FALSE(planes.GradientAt(30, 0).has_value());
  EXPECT_FALSE(planes.GradientAt(NAN, 0).has_value());
}

// One return in six is of a shrub. The slope of 36 returns has the standard deviation s / (6 x 1.73 m) = 0.29 %; half
// as much again for those that are left out, and 4 of it at the farthest of 289 places.
TEST(TerrainPlanes, AreNotTurnedByShrubs) {
  constexpr double kSigma = 0.03, kTolerance = 4 * 1.5 * kSigma / (6 * 1.73);
  std::mt19937_64 random(2);
  std::vector<Point> points = Slope(6000, kSigma, random);
  std::uniform_real_distribution<double> height(0.5, 4);
  for (std::size_t i = 0; i < points.size(); i += 6) points[i][2] += height(random);
  const TerrainPlanes planes = PlanesOf(points);
  double squares = 0;
  int count = 0;
  for (double x = -17; x <= 17; x += 2) {
    for (double y = -17; y <= 17; y += 2) {
      const auto gradient = planes.GradientAt(x, y);
      ASSERT_TRUE(gradient.has_value());
      EXPECT_NEAR(gradient->x, 0.3, kTolerance);
      EXPECT_NEAR(gradient->y, -0.2, kTolerance);
      squares += std::pow(gradient->x - 0.3, 2);
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 1.5 * kSigma / (6 * 1.73));
}

TEST(TerrainPlanes, DoNotDependOnTheOrderOrTheDivisionOfReturns) {
  std::mt19937_64 random(3);
  std::vector<Point> points = Slope(4000, 0.1, random);
  const TerrainPlanes whole = PlanesOf(points);
  std::shuffle(points.begin(), points.end(), random);
  TerrainReturns first, second;
  for (std::size_t i = 0; i < points.size(); ++i)
    (i < 700 ? first : second).Add(points[i][0], points[i][1], points[i][2]);
  first.Merge(second);
  const TerrainPlanes parts = first.Finish();
  EXPECT_EQ(whole.size(), parts.size());
  for (const Point& at : points) {
    const auto a = whole.GradientAt(at[0], at[1]), b = parts.GradientAt(at[0], at[1]);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a.has_value()) continue;
    EXPECT_EQ(a->x, b->x);
    EXPECT_EQ(a->y, b->y);
  }
}

TEST(TerrainPlanes, AreMissingWhereReturnsAreFewOrOnALine) {
  std::vector<Point> few, line;
  for (int i = 0; i < 5; ++i) few.push_back({0.4 * i, 0.3 * (i % 2), 0});
  for (int i = 0; i < 40; ++i) line.push_back({0.1 * i, 0.02 * (i % 3), 0});
  EXPECT_FALSE(PlanesOf(few).GradientAt(0.5, 0.1).has_value());
  EXPECT_FALSE(PlanesOf(line).GradientAt(1, 0.01).has_value());
}

// 1 by 1 km in cells of 2 m would be 250 000; 2 by 2 km are a million.
TEST(TerrainPlanes, OfLargeAreasHaveWiderCells) {
  TerrainReturns whole, first, second;
  int count = 0;
  const auto add = [&](double x, double y) {
    whole.Add(x, y, HeightAt(x, y));
    (count++ % 2 == 0 ? first : second).Add(x, y, HeightAt(x, y));
  };
  // Four cells side by side, far from the next four: too few returns for planes, so that Finish() is quick.
  for (int i = 0; i < 421; ++i)
    for (int k = 0; k < 421; ++k)
      for (const auto& [x, y] : {std::pair(1, 1), {1, 3}, {3, 1}, {3, 3}}) add(12 * i - 2400 + x, 12 * k - 2400 + y);
  for (const double at : {-900.0, 0.0, 700.0})
    for (int i = -10; i < 10; ++i)
      for (int k = -10; k < 10; ++k) add(at + 2 * i + 0.6 * (k & 1), 2 * k + 0.7 * (i & 1));
  first.Merge(second);
  const TerrainPlanes planes = whole.Finish(), parts = first.Finish();
  EXPECT_EQ(planes.cell(), 4);
  EXPECT_EQ(parts.cell(), 4);
  EXPECT_FALSE(planes.GradientAt(2000, 2000).has_value());
  for (const double at : {-900.0, 0.5, 700.0}) {
    EXPECT_NEAR(planes.GradientAt(at, 3)->x, 0.3, 1e-4);
    EXPECT_EQ(planes.GradientAt(at, 3)->y, parts.GradientAt(at, 3)->y);
  }
}

}  // namespace
}  // namespace albtpu
