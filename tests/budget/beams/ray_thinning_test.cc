#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "budget/beams/return_pair.h"

namespace albtpu {
namespace {

std::vector<AirRay> RandomRays(std::size_t count, double duration) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<AirRay> rays(count);
  for (AirRay& ray : rays)
    ray = {duration * uniform(random), Eigen::Vector3d::Zero(), {0, 0, -1}, 1 + 15 * uniform(random)};
  return rays;
}

TEST(RayThinning, OnlySortsWhatIsBelowItsBounds) {
  const auto rays = RandomRays(1000, 10);
  const auto kept = ThinRays(rays, {});
  EXPECT_EQ(kept.size(), rays.size());
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end(), [](auto& a, auto& b) { return a.time < b.time; }));
}

TEST(RayThinning, DoesNotDependOnTheOrderOfRays) {
  auto rays = RandomRays(30000, 1);
  const auto kept = ThinRays(rays, {});
  std::shuffle(rays.begin(), rays.end(), std::mt19937_64(2));
  const auto again = ThinRays(rays, {});
  ASSERT_EQ(kept.size(), again.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(kept[i].time, again[i].time);
    EXPECT_EQ(kept[i].separation, again[i].separation);
  }
}

TEST(RayThinning, BoundsTheRaysOfEachBinAndOfAll) {
  const auto rays = RandomRays(100000, 1);  // 500 in each bin of 5 ms.
  EXPECT_EQ(ThinRays(rays, {}).size(), 200 * 20u);
  EXPECT_EQ(ThinRays(rays, {.max_rays = 1000}).size(), 200 * 5u);
  EXPECT_EQ(ThinRays(rays, {.max_rays = 10}).size(), 200u);
}

TEST(RayThinning, KeepsTheLongerSeparations) {
  // 4 % of 1 to 16 m are kept: those of the class above 11.3 m, which holds 31 %.
  for (const AirRay& ray : ThinRays(RandomRays(100000, 1), {})) EXPECT_GE(ray.separation, std::sqrt(128));
}

TEST(RayThinning, DoesNotFavourErrorsOfTheSeparation) {
  // Separations of 13 m with errors of 0.03 m: the mean error of those kept is 0 within four standard errors.
  auto rays = RandomRays(100000, 1);
  std::mt19937_64 random(4);
  std::normal_distribution<double> error(0, 0.03);
  for (AirRay& ray : rays) ray.separation = 13 + error(random);
  double sum = 0;
  const auto kept = ThinRays(rays, {});
  for (const AirRay& ray : kept) sum += ray.separation - 13;
  const auto count = static_cast<double>(kept.size());
  EXPECT_LT(std::abs(sum / count), 4 * 0.03 / std::sqrt(count));
}

TEST(RayThinning, LeavesOutWhatIsNotFinite) {
  auto rays = RandomRays(4, 1);
  rays[0].time = std::nan("");
  rays[1].water_point.x() = std::nan("");
  rays[2].separation = 0;
  EXPECT_EQ(ThinRays(rays, {}).size(), 1u);
  EXPECT_TRUE(ThinRays({}, {}).empty());
}

}  // namespace
}  // namespace albtpu
