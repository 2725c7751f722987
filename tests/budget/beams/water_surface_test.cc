#include "budget/beams/water_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

namespace albtpu {
namespace {

struct Return {
  double x, y, time, height;
};

using Returns = std::vector<Return>;

LocalWaterSurface SurfaceOf(const Returns& returns) {
  SurfaceReturns collected;
  for (const Return& r : returns) collected.Add(r.x, r.y, r.time, r.height);
  return collected.Finish();
}

double NearestCorner(double coordinate, double cell) { return std::floor(coordinate / cell + 0.5) * cell; }

// The slow twin: sorts all returns in the window around the nearest corner. Where no cell has more than 8, none is
// left out.
std::optional<double> MedianAt(const Returns& returns, double x, double y, double time) {
  const double x0 = NearestCorner(x, 5), y0 = NearestCorner(y, 5), time0 = NearestCorner(time, 60);
  const auto within = [](double number, double middle, double half) {
    return number >= middle - half && number < middle + half;
  };
  std::vector<float> heights;
  for (const Return& r : returns)
    if (within(r.x, x0, 10) && within(r.y, y0, 10) && within(r.time, time0, 60))
      heights.push_back(static_cast<float>(r.height));
  if (heights.size() < 3) return std::nullopt;
  std::sort(heights.begin(), heights.end());
  const std::size_t middle = heights.size() / 2;
  if (heights.size() % 2 == 1) return heights[middle];
  return static_cast<float>((double{heights[middle - 1]} + heights[middle]) / 2);
}

// Two waves with a significant height of 4 x 0.12 m, whole numbers of which fit into 20 m both ways, and a tide that
// rises by 1 m in an hour.
Returns Waves(std::size_t count, double side, double duration, double outliers = 0) {
  std::mt19937_64 random(1);
  const auto draw = [&random](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  Returns returns;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = draw(-side / 2, side / 2), y = draw(-side / 2, side / 2), time = 3e8 + draw(0, duration);
    const double waves = 0.12 * std::cos(2 * std::numbers::pi * (x / 5 + y / 20)) +
                         0.12 * std::cos(2 * std::numbers::pi * (y / 4 - x / 10) + time);
    const double height = draw(0, 1) < outliers ? draw(-30, 100) : 2.5 + waves + (time - 3e8) / 3600;
    returns.push_back({x, y, time, height});
  }
  return returns;
}

class FewReturns : public testing::TestWithParam<double> {};

// Also of heights that many returns share: in steps of the parameter, in m.
TEST_P(FewReturns, HaveTheMedianOfAll) {
  Returns returns = Waves(2000, 200, 300);  // On average, a return in 4 cells and slots.
  for (Return& r : returns)
    if (GetParam() > 0) r.height = GetParam() * std::round(r.height / GetParam());
  std::map<std::tuple<double, double, double>, int> in_cell;
  for (const Return& r : returns)
    ASSERT_LE(++in_cell[std::tuple(std::floor(r.x / 5), std::floor(r.y / 5), std::floor(r.time / 60))], 8);
  const LocalWaterSurface surface = SurfaceOf(returns);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> place(-130, 130), time(-100, 400);
  LocalWaterSurface::Reader reader(surface);
  int found = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double x = place(random), y = place(random), t = 3e8 + time(random);
    const std::optional<double> median = surface.HeightAt(x, y, t);
    ASSERT_EQ(median, MedianAt(returns, x, y, t)) << x << " " << y << " " << t;
    ASSERT_EQ(reader.HeightAt(x, y, t), median);
    ASSERT_EQ(reader.HeightAt(x, y, t), median);  // Of the tile that it has.
    found += median.has_value();
  }
  EXPECT_GT(found, 4000);
  EXPECT_LT(found, 16'000);
}

INSTANTIATE_TEST_SUITE_P(HeightsOfSteps, FewReturns, testing::Values(0, 0.1, 100));

TEST(LocalWaterSurface, IsWithinItsStandardErrorWhereThereAreMany) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> height(2.5, 0.12);
  std::uniform_real_distribution<double> place(-100, 100);
  Returns returns;
  for (int i = 0; i < 400'000; ++i) returns.push_back({place(random), place(random), 0, height(random)});
  const LocalWaterSurface surface = SurfaceOf(returns);
  double sum = 0, squares = 0;
  int count = 0;
  for (double x = -80; x <= 80; x += 20) {  // Windows that have no cell in common.
    for (double y = -80; y <= 80; y += 20) {
      const double error = surface.HeightAt(x, y, 0).value() - 2.5;
      sum += error;
      squares += error * error;
      ++count;
    }
  }
  // 128 returns are kept in a window. Over 81 windows, the mean has a standard error of 1/9 of theirs, and the rms
  // one of 1/sqrt(2 * 81) = 0.08 of itself; four standard errors are allowed.
  const double expected = 0.12 * std::sqrt(std::numbers::pi / 2 / 128);
  EXPECT_EQ(count, 81);
  EXPECT_NEAR(sum / count, 0, 4 * expected / 9);
  EXPECT_NEAR(std::sqrt(squares / count) / expected, 1, 4 * 0.08);
}

TEST(LocalWaterSurface, AveragesWavesThatAreShorterThanItsWindow) {
  const LocalWaterSurface surface = SurfaceOf(Waves(400'000, 200, 1));
  for (double x = -80; x <= 80; x += 16) {
    // In the window, the phases of both waves are uniform and independent. The density of their sum, of the standard
    // deviation s = 0.12 m, is higher at its median than that of the normal distribution: at most 1.25 s / sqrt(128).
    EXPECT_NEAR(surface.HeightAt(x, -x, 3e8).value(), 2.5, 4 * 0.0133);
  }
}

TEST(LocalWaterSurface, IgnoresOutliers) {
  const Returns returns = Waves(400'000, 200, 1, 0.1);
  const LocalWaterSurface surface = SurfaceOf(returns), clean = SurfaceOf(Waves(400'000, 200, 1));
  for (double x = -80; x <= 80; x += 16) {
    // A tenth of outliers, most of them above, moves the median from the 50th percentile to at most the 56th, 0.15
    // standard deviations of 0.12 m; and the samples differ.
    EXPECT_NEAR(*surface.HeightAt(x, x, 3e8), *clean.HeightAt(x, x, 3e8), 0.15 * 0.12 + 4 * std::sqrt(2) * 0.0133);
  }
}

TEST(LocalWaterSurface, KeepsTidesApart) {
  Returns returns;
  for (int i = 0; i < 4000; ++i) {
    const double x = i % 63, y = i % 61;
    returns.push_back({x, y, 1000.0 + i / 200., 1.25});  // Two looks within 20 s
    returns.push_back({x, y, 8200.0 + i / 200., -0.5});  // and a line two hours later.
  }
  const LocalWaterSurface surface = SurfaceOf(returns);
  EXPECT_EQ(surface.HeightAt(30, 30, 1005), 1.25);
  EXPECT_EQ(surface.HeightAt(30, 30, 1020), 1.25);
  EXPECT_EQ(surface.HeightAt(30, 30, 8215), -0.5);
  EXPECT_EQ(surface.HeightAt(30, 30, 4000), std::nullopt);
}

TEST(LocalWaterSurface, UsesBothLooksOfAScannerAcrossTheBeginningOfASlot) {
  const LocalWaterSurface surface = SurfaceOf({{1, 1, 595, 2}, {2, 2, 596, 3}, {3, 1, 604, 4}});
  for (const double time : {590, 599, 601, 610}) EXPECT_EQ(surface.HeightAt(1, 1, time), 3) << time;
}

TEST(LocalWaterSurface, IsAbsentWhereNoReturnsAre) {
  const LocalWaterSurface nothing = SurfaceReturns().Finish();
  EXPECT_EQ(nothing.HeightAt(0, 0, 0), std::nullopt);
  const LocalWaterSurface two = SurfaceOf({{0, 0, 0, 1}, {1, 1, 0, 1}});
  EXPECT_EQ(two.HeightAt(0, 0, 0), std::nullopt);
  const LocalWaterSurface three = SurfaceOf({{0, 0, 0, 1}, {1, 1, 0, 1}, {1, 0, 0, 7}});
  EXPECT_EQ(three.HeightAt(0, 0, 0), 1);
  EXPECT_EQ(three.HeightAt(40, 0, 0), std::nullopt);
  EXPECT_EQ(three.HeightAt(0, 0, 900), std::nullopt);
}

TEST(LocalWaterSurface, IgnoresReturnsWithoutANumber) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  SurfaceReturns returns;
  for (const double bad : {nan, infinity, -infinity, 1e300})
    for (int i = 0; i < 4; ++i) returns.Add(i == 0 ? bad : 0, i == 1 ? bad : 0, i == 2 ? bad : 0, i == 3 ? bad : 0);
  EXPECT_EQ(returns.bytes(), 0);
  const LocalWaterSurface surface = returns.Finish();
  for (const double bad : {nan, infinity, 1e300}) EXPECT_EQ(surface.HeightAt(0, bad, 0), std::nullopt);
}

TEST(LocalWaterSurface, DependsNeitherOnTheOrderNorOnThePartsOfTheReturns) {
  Returns returns = Waves(200'000, 150, 120);
  returns.insert(returns.end(), returns.begin(), returns.begin() + 1000);  // Some twice.
  const LocalWaterSurface whole = SurfaceOf(returns);
  std::shuffle(returns.begin(), returns.end(), std::mt19937(3));
  std::vector<SurfaceReturns> parts(7);
  for (std::size_t i = 0; i < returns.size(); ++i) {
    const Return& r = returns[i];
    parts[i * i % 7].Add(r.x, r.y, r.time, r.height);
  }
  SurfaceReturns merged;
  for (SurfaceReturns& part : parts) merged.Merge(std::move(part));
  const LocalWaterSurface surface = merged.Finish();
  for (double x = -80; x <= 80; x += 2.5)
    for (double time = 0; time < 120; time += 25)
      EXPECT_EQ(surface.HeightAt(x, -x / 2, 3e8 + time), whole.HeightAt(x, -x / 2, 3e8 + time));
}

TEST(SurfaceReturns, TakeMemoryForTheAreaNotForTheirNumber) {
  SurfaceReturns few, many;
  for (const Return& r : Waves(20'000, 150, 1)) few.Add(r.x, r.y, r.time, r.height);
  for (const Return& r : Waves(500'000, 150, 1)) many.Add(r.x, r.y, r.time, r.height);
  EXPECT_EQ(many.bytes(), few.bytes());
}

}  // namespace
}  // namespace albtpu
