#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <vector>

#include "budget/beams/displacement_fit.h"
#include "budget/beams/return_pair.h"
#include "sea/response/closed_form.h"

namespace albtpu {
namespace {

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
  constexpr double kS = 0.05, kN = kRefractiveIndex, kHalf = 6;
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
