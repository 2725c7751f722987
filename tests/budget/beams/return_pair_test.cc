#include "budget/beams/return_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sea/response/closed_form.h"

namespace albtpu {
namespace {

constexpr double kN = kRefractiveIndex;
const ReturnPair kPlain{.time = 5, .upper = {0.1, 0, -1}, .lower = {0.3, 0, -3}};

TEST(RayOfPair, RecoversTheBeamThroughStillWater) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const double incidence = 0.8 * uniform(random), azimuth = 6.28 * uniform(random), level = 40 * uniform(random);
    const Eigen::Vector3d beam(std::sin(incidence) * std::cos(azimuth), std::sin(incidence) * std::sin(azimuth),
                               -std::cos(incidence));
    const Eigen::Vector3d in_water = Refract(beam, Eigen::Vector3d::UnitZ(), kN);
    const Eigen::Vector3d water(300 * uniform(random), -200 * uniform(random), level);
    const double near = 0.1 + uniform(random), separation = 1.01 + 10 * uniform(random);
    const ReturnPair pair{7, water + near * in_water, water + (near + separation) * in_water};
    const auto ray = RayOfPair(pair, level, kN);
    ASSERT_TRUE(ray);
    // Coordinates up to 300 m have errors of 6e-14 m; over 1 m they turn the ray by some 1e-13.
    EXPECT_LT((ray->direction - beam).norm(), 1e-12);
    EXPECT_LT((ray->water_point - water).norm(), 1e-11);
    EXPECT_NEAR(ray->separation, separation, 1e-12);
    EXPECT_EQ(ray->time, 7);
  }
}

TEST(RayOfPair, AtNadirGoesStraightOn) {
  const auto ray = RayOfPair({.time = 0, .upper = {2, 3, -1}, .lower = {2, 3, -4}}, 0, kN);
  ASSERT_TRUE(ray);
  EXPECT_EQ(ray->direction, Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(ray->water_point, Eigen::Vector3d(2, 3, 0));
}

TEST(RayOfPair, NeedsBothReturnsBelowTheWater) {
  EXPECT_TRUE(RayOfPair(kPlain, 0, kN));
  EXPECT_FALSE(RayOfPair(kPlain, -1, kN));
  EXPECT_FALSE(RayOfPair(kPlain, -2, kN));
}

TEST(RayOfPair, NeedsASeparation) {
  EXPECT_TRUE(RayOfPair(kPlain, 0, kN, 2));
  EXPECT_FALSE(RayOfPair(kPlain, 0, kN, 2.1));
}

TEST(RayOfPair, NeedsTheLowerReturnToLieLower) {
  EXPECT_FALSE(RayOfPair({.time = 0, .upper = kPlain.lower, .lower = kPlain.upper}, 0, kN));
  EXPECT_FALSE(RayOfPair({.time = 0, .upper = {0, 0, -1}, .lower = {3, 0, -1}}, 0, kN));
}

TEST(RayOfPair, NeedsADirectionThatABeamFromAirCanHave) {
  // Beyond asin(1 / n) = 48.8 degrees from the vertical there is none.
  EXPECT_TRUE(RayOfPair({.time = 0, .upper = {0, 0, -1}, .lower = {2.2, 0, -3}}, 0, kN));
  EXPECT_FALSE(RayOfPair({.time = 0, .upper = {0, 0, -1}, .lower = {2.4, 0, -3}}, 0, kN));
}

TEST(RayOfPair, NeedsFiniteNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(RayOfPair({.time = nan, .upper = kPlain.upper, .lower = kPlain.lower}, 0, kN));
  EXPECT_FALSE(RayOfPair({.time = 0, .upper = {nan, 0, -1}, .lower = kPlain.lower}, 0, kN));
  EXPECT_FALSE(RayOfPair({.time = 0, .upper = kPlain.upper, .lower = {0, 0, nan}}, 0, kN));
  EXPECT_FALSE(RayOfPair(kPlain, nan, kN));
}

}  // namespace
}  // namespace albtpu
