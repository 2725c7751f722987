// Pairs of points in patches, and what is predicted of them.
#include "quality/crosscheck/overlap_patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sea/sea_state.h"

namespace albtpu::quality {
namespace {

Patch TwoPlanes(double slope_x, double slope_y, double step) {
  Patch patch;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-2.5F, 2.5F);
  for (int i = 0; i < 40; ++i) {
    PatchPoint point{
        .x = place(random), .y = place(random), .variance_air = 0.01F, .line = static_cast<std::uint16_t>(i % 2)};
    point.z = static_cast<float>(-8 + slope_x * point.x + slope_y * point.y + (i % 2 == 0 ? step : 0));
    patch.points.push_back(point);
  }
  return patch;
}

TEST(CrossPairs, AreFreeOfTheSlope) {
  Patch patch = TwoPlanes(0.3, -0.2, 0.07);
  PatchPairs of_patch;
  AppendPairs(patch, SharedWaves(), of_patch);
  const std::vector<CrossPair>& pairs = of_patch.across;
  ASSERT_EQ(pairs.size(), 1U);
  ASSERT_EQ(of_patch.within.size(), 2U);
  EXPECT_NEAR(of_patch.within[0].difference, 0, 1e-5);
  EXPECT_NEAR(pairs[0].difference, 0.07, 1e-5);
  EXPECT_LT(pairs[0].distance, 0.5);
  EXPECT_NEAR(pairs[0].variance_air(), 0.02, 1e-7);
}

// Two lines over a bottom that rises by 0.3 to the east, of beams to the east and to the west.
TEST(CrossPairs, AreFreeOfThePredictedBias) {
  const auto pair = [](float vertical, float along_beam) {
    std::vector<AnnotatedPoint> points;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(5, 10);
    for (int i = 0; i < 40; ++i) {
      AnnotatedPoint& point = points.emplace_back();
      const double east = place(random), sign = i % 2 == 0 ? 1 : -0.5;
      point.beam_azimuth = i % 2 == 0 ? 90 : 270;
      point.bias_vertical = static_cast<float>(sign) * vertical;
      point.bias_along_beam = along_beam;
      point.x = east + (i % 2 == 0 ? 1 : -1) * along_beam;
      point.y = place(random);
      point.z = -8 + 0.3 * east + point.bias_vertical;
      point.line = 1 + i % 2;
      point.has_number = true;
      point.tvu_pulse = 0.1F;
    }
    OverlapPatches patches(5, 1, Coverage::kOneSigma);
    patches.Find(points);
    patches.Choose();
    patches.Fill(points, PulseOnWater::kNoSea);
    PatchPairs pairs;
    for (Patch& patch : patches.Take()) AppendPairs(patch, SharedWaves(), pairs);
    return pairs.across.at(0);
  };
  EXPECT_NEAR(pair(0, 0).difference, 0, 1e-5);
  EXPECT_NEAR(pair(-0.05F, 0).difference, 0, 1e-5);
  EXPECT_NEAR(pair(-0.05F, 0.04F).difference, 0, 1e-5);
}

// The variance of the height above a slope is g' C g with g = (-0.3, 0.2, 1): here of each point
// 0.01 + 0.09 0.04 + 0.04 0.02 + 2 (-0.06) 0.005 - 2 (0.3 0.004 - 0.2 0.003) = 0.0126.
TEST(CrossPairs, HaveTheVarianceAboveTheSlope) {
  Patch patch = TwoPlanes(0.3, -0.2, 0);
  for (PatchPoint& point : patch.points) {
    point.xx = 0.04F, point.yy = 0.02F, point.xy = 0.005F, point.xz = 0.004F, point.yz = 0.003F;
    point.sea_in_horizontal = 0.25F;
  }
  PatchPairs of_patch;
  AppendPairs(patch, SharedWaves(), of_patch);
  const std::vector<CrossPair>& pairs = of_patch.across;
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR(pairs[0].variance_air(), 2 * (0.01 + 0.75 * 0.0026), 1e-6);
  EXPECT_NEAR(pairs[0].variance_sea(), 2 * 0.25 * 0.0026, 1e-6);
  for (PatchPoint& point : patch.points) point.xz = 0.02F;  // Down the slope is too low: less than on a level bottom.
  of_patch = {};
  AppendPairs(patch, SharedWaves(), of_patch);
  EXPECT_NEAR(pairs[0].variance(), 2 * (0.0126 - 2 * 0.3 * 0.016), 1e-6);
  EXPECT_EQ(pairs[0].variance_sea(), 0);
}

// Beams from the west over a bottom that rises by 0.3 to the east, at 20 degrees: with b = 0.232 and a = 0.161,
// heights err by (b + 0.3 a) / b = 1.208 times as much as on a level bottom.
TEST(CrossPairs, HaveMoreOfTheHeightsOfWavesWhereBeamsGoUpTheSlope) {
  const WindSea wind{.wind_speed_10m = 8, .model = &kElfouhailyModel};
  SharedWaves waves;
  waves.Add({.spectrum = Sampled(*wind.MakeSpectrum(), SeaWavenumbers(), kSeaHarmonics), .water_index = 1.34});
  const auto heights = [&](double slope) {
    Patch patch = TwoPlanes(slope, 0, 0);
    for (PatchPoint& point : patch.points) {
      point.variance_sea = 0.01F, point.sea_in_horizontal = 1;
      const double by_height = -0.161 / 0.232 * 0.01;
      point.xz = static_cast<float>(by_height), point.xx = static_cast<float>(by_height * by_height / 0.01);
      point.incidence = 20, point.azimuth = 90, point.footprint = 0.5, point.depth = 0.01F, point.sea = 0;
    }
    PatchPairs pairs;
    AppendPairs(patch, waves, pairs);
    return pairs.across.at(0).a.variance_heights;
  };
  EXPECT_NEAR(heights(0), 0.01, 1e-5);
  EXPECT_NEAR(heights(0.3), 0.01 * 1.208 * 1.208, 1e-4);
  EXPECT_NEAR(heights(-0.3), 0.01 * 0.792 * 0.792, 1e-4);
}

TEST(CrossPairs, NeedTwoLinesAndASlope) {
  PatchPairs pairs;
  Patch one = TwoPlanes(0, 0, 0);
  for (PatchPoint& point : one.points) point.line = 1;
  AppendPairs(one, SharedWaves(), pairs);
  Patch row = TwoPlanes(0, 0, 0);
  for (PatchPoint& point : row.points) point.y = point.x;  // All in one straight line.
  AppendPairs(row, SharedWaves(), pairs);
  EXPECT_TRUE(pairs.across.empty());
}

}  // namespace
}  // namespace albtpu::quality
