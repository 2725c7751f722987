#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sea/response/closed_form.h"

namespace albtpu {
namespace {

constexpr double kN = kRefractiveIndex;

// What the header says of the differences.
constexpr double kDifferences = 1e-6;

TEST(EffectiveGains, OfStillWaterAreThoseOfSmallSlopes) {
  const double incidence = 0.35, refracted = StillWaterRefraction(incidence, kN);
  const EffectiveGains gains = EffectiveGainsOf(incidence, kN, Eigen::Matrix2d::Zero());
  EXPECT_NEAR(gains.mean.x(), std::tan(refracted), 1e-14);
  EXPECT_NEAR(gains.mean.y(), 0, 1e-14);
  EXPECT_NEAR(gains.mean.z(), 1 / std::cos(refracted), 1e-14);
  const SlopeGain gain = SmallSlopeGain(incidence, kN);
  EXPECT_NEAR(gains.gain(0, 0), gain.in_plane, kDifferences);
  EXPECT_NEAR(gains.gain(1, 1), gain.out_of_plane, kDifferences);
  EXPECT_NEAR(gains.gain(2, 0), gain.in_plane * std::sin(refracted), kDifferences);
  EXPECT_LT((gains.curvature[2] - SecantCurvature(incidence, 0, kN)).norm(), 4 * kDifferences);
}

// The third order in slope (docs/physics.md): the gain by m_x falls by c (3 s_x^2 + s_y^2). The next order is smaller
// by some ten mean square slopes.
TEST(EffectiveGains, FallWithTheSlopesOfTheSea) {
  const double g = 1 - 1 / kN, c = 1.0 / 3 - 1 / (2 * kN) + 1 / (6 * kN * kN * kN) - g * g * g / 3;
  const double x = 7e-4, y = 5e-4;
  const EffectiveGains gains = EffectiveGainsOf(0, kN, Eigen::Vector2d(x, y).asDiagonal());
  EXPECT_NEAR((g - gains.gain(0, 0)) / (c * (3 * x + y)), 1, 10 * (x + y));
  EXPECT_NEAR((g - gains.gain(1, 1)) / (c * (x + 3 * y)), 1, 10 * (x + y));
}

// The slow twin: regression of the ray on the slope over a fine grid of slopes, each weighted by the area that it turns
// towards the beam: covariance under the weight times the inverse of the slopes' covariance.
TEST(EffectiveGains, AreTheRegressionOfTheRayOnTheSlope) {
  const double incidence = 0.4, tau = std::tan(incidence);
  const Eigen::Matrix2d slopes = (Eigen::Matrix2d() << 0.04, 0.01, 0.01, 0.025).finished();
  const Eigen::Matrix2d inverse = slopes.inverse(), root = slopes.llt().matrixL();
  const Eigen::Vector3d incident(std::sin(incidence), 0, -std::cos(incidence));
  double weights = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector2d mean_slope = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 3, 2> products = Eigen::Matrix<double, 3, 2>::Zero();
  constexpr double kStep = 0.05;
  for (double u = -7; u <= 7; u += kStep) {
    for (double v = -7; v <= 7; v += kStep) {
      const Eigen::Vector2d slope = root * Eigen::Vector2d(u, v);
      const RefractedRay ray = RefractAtSlope(incident, slope, kN);
      const Eigen::Vector3d value(ray.tangent.x(), ray.tangent.y(), ray.secant);
      const double weight = std::exp(-(u * u + v * v) / 2) * std::max(0.0, 1 + tau * slope.x());
      weights += weight;
      mean += weight * value;
      mean_slope += weight * slope;
      products += weight * value * slope.transpose();
    }
  }
  mean /= weights;
  mean_slope /= weights;
  const EffectiveGains gains = EffectiveGainsOf(incidence, kN, slopes);
  EXPECT_LT((gains.mean - mean).norm(), 1e-6);
  EXPECT_LT((mean_slope - tau * slopes.col(0)).norm(), 1e-6);
  const Eigen::Matrix<double, 3, 2> regression = (products / weights - mean * mean_slope.transpose()) * inverse;
  EXPECT_LT((gains.gain - regression).norm(), 2 * kDifferences);
}

}  // namespace
}  // namespace albtpu
