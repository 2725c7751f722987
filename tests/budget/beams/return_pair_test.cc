#include "budget/beams/return_pair.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "budget/beams/displacement_fit.h"
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

struct Residuals {
  std::vector<double> squares, separations;
};

Residuals Draw(const RayNoise& noise, std::size_t count) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  Residuals drawn;
  for (std::size_t i = 0; i < count; ++i) {
    drawn.separations.push_back(1 + 9 * uniform(random));
    const double sigma = uniform(random) < noise.outlier_share ? noise.outlier_sigma
                                                               : std::sqrt(noise.Variance(drawn.separations.back()));
    const double x = sigma * normal(random), y = sigma * normal(random);
    drawn.squares.push_back(x * x + y * y);
  }
  return drawn;
}

TEST(RayNoise, TellsSlopesFromErrorsOfPointsAndFromOutliers) {
  const RayNoise truth{.slopes = 0.02, .points = 0.05, .outlier_share = 0.3, .outlier_sigma = 0.35};
  const Residuals drawn = Draw(truth, 40000);
  const RayNoise found =
      FitRayNoise(drawn.squares, drawn.separations, RobustRayNoise(drawn.squares, drawn.separations), 200);
  // 28000 good rays tell a standard deviation to 0.4 %, and its two causes to about 2 % each; four of these.
  EXPECT_NEAR(found.slopes / truth.slopes, 1, 0.08);
  EXPECT_NEAR(found.points / truth.points, 1, 0.08);
  EXPECT_NEAR(found.outlier_share, truth.outlier_share, 4 * std::sqrt(0.21 / 40000) + 0.005);
  EXPECT_NEAR(found.outlier_sigma / truth.outlier_sigma, 1, 0.04);
}

TEST(RayNoise, FindsNoSlopesInFlatWater) {
  const Residuals drawn = Draw({.slopes = 0, .points = 0.05, .outlier_share = 0, .outlier_sigma = 0.3}, 20000);
  const RayNoise found =
      FitRayNoise(drawn.squares, drawn.separations, RobustRayNoise(drawn.squares, drawn.separations), 200);
  EXPECT_LT(found.slopes, 0.002);  // Less than the errors of points at 10 m, 0.005, by far.
  EXPECT_NEAR(found.points / 0.05, 1, 0.03);
}

// The weight is the gradient of the log-likelihood of the mixture, the response its divergence: finite differences.
TEST(RayNoise, WeighsByTheLikelihood) {
  const RayNoise noise{.slopes = 0.02, .points = 0.04, .outlier_share = 0.2, .outlier_sigma = 0.3};
  constexpr double kSeparation = 2, kStep = 1e-5;
  const double good = noise.Variance(kSeparation), bad = 0.09;
  const auto log_likelihood = [&](double x, double y) {
    const double square = x * x + y * y;
    return std::log(0.8 / good * std::exp(-square / (2 * good)) + 0.2 / bad * std::exp(-square / (2 * bad)));
  };
  for (const double x : {0.005, 0.03, 0.07, 0.09, 0.1, 0.2}) {
    const RayWeight at = WeightOf(noise, kSeparation, x * x);
    const auto f = [&](double dx, double dy) { return log_likelihood(x + dx, dy); };
    const double gradient = (f(kStep, 0) - f(-kStep, 0)) / (2 * kStep);
    const double laplacian = (f(kStep, 0) + f(-kStep, 0) + f(0, kStep) + f(0, -kStep) - 4 * f(0, 0)) / (kStep * kStep);
    EXPECT_NEAR(-gradient / x, at.weight, 1e-4 * at.weight) << x;
    // Rounding of 1e-15 over the square of the step.
    EXPECT_NEAR(-laplacian / 2, at.response, 1e-3 * (1 / good)) << x;
  }
}

// The mean over normal slopes of the angle of rays, each facet with its area as the beam sees it, by quadrature.
TEST(FacingSlopes, AgreesWithTheMeanOverASea) {
  constexpr double kS = 0.05, kHalf = 6;
  for (const double incidence : {0.1, 0.35, 0.6}) {
    const Eigen::Vector3d beam(std::sin(incidence), 0, -std::cos(incidence));
    double sum = 0, square = 0, weight = 0;
    for (double x = -kHalf; x <= kHalf; x += 0.1) {
      for (double y = -kHalf; y <= kHalf; y += 0.1) {
        const Eigen::Vector2d slope(kS * x, kS * y);
        const double w = std::exp(-(x * x + y * y) / 2) * (1 + slope.x() * std::tan(incidence));
        const Eigen::Vector3d in_water = Refract(beam, NormalOfSlope(slope), kN);
        const Eigen::Vector2d u = kN * in_water.head<2>();
        const Eigen::Vector3d ray(u.x(), u.y(), -std::sqrt(1 - u.squaredNorm()));
        const Eigen::Vector3d outward(std::cos(incidence), 0, std::sin(incidence));
        const double sine = std::hypot(ray.dot(outward), ray.y());
        const double scale = sine > 0 ? std::atan2(sine, ray.dot(beam)) / sine : 1;
        sum += w * scale * ray.dot(outward);
        square += w * scale * scale * (std::pow(ray.dot(outward), 2) + ray.y() * ray.y()) / 2;
        weight += w;
      }
    }
    const FacingSlopes slopes = FacingSlopesAt(incidence, kN);
    // What is left out is of fourth order in the slope: some s^2 = 0.25 %, times small numbers.
    EXPECT_NEAR(sum / weight / (kS * kS), slopes.bias, 0.02 * slopes.bias) << incidence;
    EXPECT_NEAR(std::sqrt(square / weight) / kS, slopes.gain, 0.02 * slopes.gain) << incidence;
    EXPECT_GT(slopes.bias, 0);
  }
}

}  // namespace
}  // namespace albtpu
