#include "annotate/beams/water_heights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "formats/trajectories/water_level_file.h"

namespace albtpu::annotate {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kFoot = 0.3048;  // m, exact.

// Points at these x, y = 0 and z = -5.
SurveyPoints PointsAt(std::vector<double> x, std::vector<double> times) {
  SurveyPoints points;
  points.y.assign(x.size(), 0);
  points.z.assign(x.size(), -5);
  points.x = std::move(x);
  points.times = std::move(times);
  return points;
}

// The water lies at `height` [m] within a few metres of the origin of the local frame, at the time 0.
LocalWaterSurface SurfaceAtTheOrigin(double height) {
  SurfaceReturns returns;
  for (int i = 0; i < 5; ++i) returns.Add(0.5 * i, 0, 0, height);
  return returns.Finish();
}

formats::WaterLevelSeries Levels(const std::string& text) {
  absl::StatusOr<formats::WaterLevelSeries> series = formats::ParseWaterLevels("tide.csv", "time,water_level\n" + text);
  EXPECT_TRUE(series.ok()) << series.status();
  return *std::move(series);
}

struct Answer {
  std::vector<double> heights;
  SurfaceCounts counts;
};
Answer Ask(const WaterHeights& water, const SurveyPoints& points, const formats::LocalFrame& frame = {}) {
  Answer answer;
  answer.heights = {99, 99, 99, 99, 99, 99, 99};  // What is left of another use does not matter.
  water.At(points, frame, answer.heights, answer.counts);
  EXPECT_EQ(answer.heights.size(), points.size());
  return answer;
}

TEST(WaterHeights, TrustThePulseFirstThenReturnsNearbyThenTheLevel) {
  const LocalWaterSurface surface = SurfaceAtTheOrigin(2);
  SurveyPoints points = PointsAt({0, 0, 1000, 1000}, {0, 0, 0, 0});
  points.pulse_surface = {1, kNan, 1.5, kNan};
  const Answer answer = Ask({.surface = &surface, .levels = nullptr, .level = 3}, points);
  EXPECT_EQ(answer.heights, (std::vector<double>{1, 2, 1.5, 3}));
  EXPECT_EQ(answer.counts[SurfaceFrom::kPulse], 2u);
  EXPECT_EQ(answer.counts[SurfaceFrom::kLocal], 1u);
  EXPECT_EQ(answer.counts[SurfaceFrom::kLevel], 1u);
}

TEST(WaterHeights, AreNotKnownWhereNoSourceKnowsThem) {
  const LocalWaterSurface surface = SurfaceAtTheOrigin(2);
  const Answer answer = Ask({.surface = &surface, .levels = nullptr, .level = {}}, PointsAt({0, 1000}, {0, 0}));
  EXPECT_EQ(answer.heights[0], 2);
  EXPECT_TRUE(std::isnan(answer.heights[1]));
  EXPECT_EQ(answer.counts[SurfaceFrom::kLevel], 0u);
  EXPECT_TRUE(std::isnan(Ask({}, PointsAt({0}, {0})).heights[0]));
}

TEST(WaterHeights, FollowTheLevelByTime) {
  const formats::WaterLevelSeries levels = Levels("1000,-20\n1400,-22\n");
  const Answer answer = Ask({.surface = nullptr, .levels = &levels, .level = {}},
                            PointsAt({0, 0, 0, 0, 0}, {1000, 1100, 1400, 999, 1401}));
  EXPECT_EQ(answer.heights[0], -20);
  EXPECT_DOUBLE_EQ(answer.heights[1], -20.5);
  EXPECT_EQ(answer.heights[2], -22);
  EXPECT_TRUE(std::isnan(answer.heights[3]) && std::isnan(answer.heights[4]));  // Not extrapolated.
  EXPECT_EQ(answer.counts[SurfaceFrom::kLevel], 3u);
}

TEST(WaterHeights, OfReturnsNearbyBelongToTheirTime) {
  const LocalWaterSurface surface = SurfaceAtTheOrigin(2);
  const Answer answer = Ask({.surface = &surface, .levels = nullptr, .level = -1}, PointsAt({0, 0}, {0, 3600}));
  EXPECT_EQ(answer.heights, (std::vector<double>{2, -1}));
}

TEST(WaterHeights, NeedNoTimesWhereTheFileHasNone) {
  const LocalWaterSurface surface = SurfaceAtTheOrigin(2);
  const Answer answer = Ask({.surface = &surface, .levels = nullptr, .level = -1}, PointsAt({0, 1000}, {}));
  EXPECT_EQ(answer.heights, (std::vector<double>{2, -1}));
}

// A survey in feet, on the map and in height: the local surface is in the local frame, in metres, all else in feet.
TEST(WaterHeights, AreMetresWhereThePointsAreInFeet) {
  const formats::LocalFrame frame = {
      .origin_x = 5000, .origin_y = 0, .metres_per_x = kFoot, .metres_per_y = kFoot, .metres_per_z = kFoot};
  const LocalWaterSurface surface = SurfaceAtTheOrigin(2);
  SurveyPoints points = PointsAt({5000, 5000, 9000}, {0, 0, 0});
  points.pulse_surface = {10, kNan, kNan};
  const Answer constant = Ask({.surface = &surface, .levels = nullptr, .level = 20}, points, frame);
  EXPECT_EQ(constant.heights, (std::vector<double>{10 * kFoot, 2, 20 * kFoot}));
  const formats::WaterLevelSeries levels = Levels("-100,30\n100,30\n");
  const Answer series = Ask({.surface = &surface, .levels = &levels, .level = {}}, points, frame);
  EXPECT_EQ(series.heights, (std::vector<double>{10 * kFoot, 2, 30 * kFoot}));
}

TEST(SurfaceCounts, AddUpOverThePartsOfAFile) {
  SurfaceCounts all, part;
  all.Add(SurfaceFrom::kPulse);
  part.Add(SurfaceFrom::kLevel);
  part.Add(SurfaceFrom::kLocal);
  part.Add(SurfaceFrom::kLevel);
  all.Merge(part);
  EXPECT_EQ(all.Json().dump(), R"({"pulse":1,"local":1,"level":2})");
  EXPECT_EQ(all.Text(), "from a return of the same pulse at 1 points, from returns nearby at 1, from the level at 2");
}

constexpr double kIndex = 1.34;

// A pair whose upper return lies at (x, 0, -5), and whose lower one is 1 m across and `drop` [m] down from it.
ReturnPair PairAt(double time, double x, double drop) {
  return {.time = time, .upper = {x, 0, -5}, .lower = {x + 1, 0, -5 - drop}};
}

std::vector<AirRay> RaysOver(double level, const std::vector<ReturnPair>& pairs,
                             const formats::LocalFrame& frame = {}) {
  return RaysOfPairs(pairs, {.surface = nullptr, .levels = nullptr, .level = level}, frame, kIndex);
}

void ExpectSame(const AirRay& ray, const std::optional<AirRay>& expected) {
  ASSERT_TRUE(expected.has_value());
  EXPECT_EQ(ray.time, expected->time);
  EXPECT_EQ(ray.water_point, expected->water_point);
  EXPECT_EQ(ray.direction, expected->direction);
  EXPECT_EQ(ray.separation, expected->separation);
}

TEST(PairRays, AreThoseOfThePairsOverTheWater) {
  const std::vector<ReturnPair> pairs = {PairAt(1, 0, 4), PairAt(2, 10, 5)};
  const std::vector<AirRay> rays = RaysOver(-1, pairs);
  ASSERT_EQ(rays.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) ExpectSame(rays[i], RayOfPair(pairs[i], -1, kIndex));
}

TEST(PairRays, CountTheLongestPairOfEachPulse) {
  const std::vector<ReturnPair> pairs = {PairAt(1, 0, 3), PairAt(1, 0, 7), PairAt(1, 0, 5), PairAt(2, 0, 4)};
  const std::vector<AirRay> rays = RaysOver(0, pairs);
  ASSERT_EQ(rays.size(), 2u);
  ExpectSame(rays[0], RayOfPair(pairs[1], 0, kIndex));
  ExpectSame(rays[1], RayOfPair(pairs[3], 0, kIndex));
}

TEST(PairRays, PassOverALongerPairThatMakesNoRay) {
  // At 60 degrees in water, 1.34 sin is above 1: total reflection.
  const ReturnPair flat = {.time = 1, .upper = {0, 0, -5}, .lower = {17.3, 0, -15}};
  ReturnPair above = PairAt(1, 0, 9);
  above.upper.z() = 1;  // Above the water.
  const std::vector<AirRay> rays = RaysOver(0, {flat, above, PairAt(1, 0, 3), flat});
  ASSERT_EQ(rays.size(), 1u);
  ExpectSame(rays[0], RayOfPair(PairAt(1, 0, 3), 0, kIndex));
}

// Pairs are worked on in parts of 16 384.
TEST(PairRays, OfOnePulseAreOneWhereverItsPairsLie) {
  for (const int longest : {0, 1, 2}) {
    std::vector<ReturnPair> pairs;
    for (int i = 0; i < 50000; ++i) {
      const int of_pulse = i % 3;
      ReturnPair pair = PairAt(1 + i / 3, 0, of_pulse == longest ? 7 : 4);
      if (i >= 33000 && i < 49500) pair.upper.z() = 100;  // Above the water: a whole part makes no ray.
      pairs.push_back(pair);
    }
    const std::vector<AirRay> rays = RaysOver(0, pairs);
    ASSERT_EQ(rays.size(), (33000u + 500u + 2) / 3);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const std::size_t pulse = i < 11000 ? i : i + 5500;
      const std::size_t expected = std::min(3 * pulse + static_cast<std::size_t>(longest), pairs.size() - 1);
      ExpectSame(rays[i], RayOfPair(pairs[expected], 0, kIndex));
    }
  }
}

TEST(PairRays, MeetTheWaterAtItsPlaceAndTime) {
  SurfaceReturns returns;
  for (int i = 0; i < 5; ++i) {
    returns.Add(0.5 * i, 0, 0, -1);
    returns.Add(1000 + 0.5 * i, 0, 0, -2);
  }
  const LocalWaterSurface surface = returns.Finish();
  const std::vector<ReturnPair> pairs = {PairAt(1, 0, 4), PairAt(2, 1000, 4), PairAt(3, 5000, 4), PairAt(3600, 0, 4)};
  const std::vector<AirRay> rays =
      RaysOfPairs(pairs, {.surface = &surface, .levels = nullptr, .level = {}}, {}, kIndex);
  ASSERT_EQ(rays.size(), 2u);  // The water is not known at the third pair, nor an hour later.
  EXPECT_EQ(rays[0].water_point.z(), -1);
  EXPECT_EQ(rays[1].water_point.z(), -2);
}

TEST(PairRays, AreInMetresWhereThePointsAreInFeet) {
  const formats::LocalFrame feet = {
      .origin_x = 2e6, .origin_y = 1e6, .metres_per_x = kFoot, .metres_per_y = kFoot, .metres_per_z = kFoot};
  const ReturnPair pair = PairAt(1, 30, 4);
  const std::vector<AirRay> rays = RaysOver(-10, {pair}, feet);
  ASSERT_EQ(rays.size(), 1u);
  ExpectSame(rays[0], RayOfPair(pair, -10 * kFoot, kIndex));
  // The local surface is looked up where the upper return lies in the local frame.
  SurfaceReturns returns;
  for (int i = 0; i < 5; ++i) returns.Add(30 + 0.5 * i, 0, 0, -3);
  const LocalWaterSurface surface = returns.Finish();
  const std::vector<AirRay> local =
      RaysOfPairs({&pair, 1}, {.surface = &surface, .levels = nullptr, .level = {}}, feet, kIndex);
  ASSERT_EQ(local.size(), 1u);
  ExpectSame(local[0], RayOfPair(pair, -3, kIndex));
}

TEST(PairRays, AreNoneWithoutAWaterSurface) {
  EXPECT_TRUE(RaysOfPairs(std::vector<ReturnPair>{PairAt(1, 0, 4)}, {}, {}, kIndex).empty());
  EXPECT_TRUE(RaysOver(0, {}).empty());
}

// Returns from waves of a standard deviation of 0.2 m, and from bottom and water column below.
TEST(PairRays, AreNoneOfReturnsFromTroughs) {
  constexpr int kReturns = 1000;
  constexpr double kDeviation = 0.2;
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, kDeviation);
  std::vector<ReturnPair> waves, others;
  for (int i = 0; i < kReturns; ++i) {
    waves.push_back(PairAt(i, 0, 4));
    waves.back().upper.z() = normal(random);  // And the lower one at -9 m.
    others.push_back(PairAt(i + 0.5, 0, 4));
  }
  const auto rays = [](const std::vector<ReturnPair>& pairs) { return RaysOver(0, pairs).size(); };
  EXPECT_LT(rays(waves), 0.003 * kReturns);  // Nearly a half lies below the level.
  std::vector<ReturnPair> both = waves;
  both.insert(both.end(), others.begin(), others.end());
  std::ranges::sort(both, {}, &ReturnPair::time);
  EXPECT_GE(rays(both), kReturns);
  EXPECT_LT(rays(both), 1.003 * kReturns);
  // Of the class of the bottom they are taken at their word.
  for (ReturnPair& pair : waves) pair.upper_is_bottom = true;
  EXPECT_GT(rays(waves), 0.4 * kReturns);
}

}  // namespace
}  // namespace albtpu::annotate
