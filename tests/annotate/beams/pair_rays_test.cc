#include <gtest/gtest.h>

#include <optional>

#include "annotate/beams/water_heights.h"

namespace albtpu::annotate {
namespace {

constexpr double kIndex = 1.34;
constexpr double kFoot = 0.3048;  // m, exact.

// A pair whose upper return lies at (x, 0, -5), and whose lower one is 1 m across and `drop` [m] down from it.
ReturnPair PairAt(double time, double x, double drop) {
  return {.time = time, .upper = {x, 0, -5}, .lower = {x + 1, 0, -5 - drop}};
}

std::vector<AirRay> RaysOver(double level, const std::vector<ReturnPair>& pairs, const LocalFrame& frame = {}) {
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
  const LocalFrame feet = {
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

}  // namespace
}  // namespace albtpu::annotate
