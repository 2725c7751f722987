#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "generator/math/random_stream.h"
#include "generator/water/photon_walk.h"

namespace albtpu {
namespace {

constexpr double kPi = std::numbers::pi;

// The phase function itself [1/sr], for a backscatter fraction of 0.0183 (Fournier and Jonasz (1999), Eq. 10).
double FournierForandValue(double psi) {
  const double mu = 3.5834, n = 1.01 + 0.1542 * (mu - 3), nu = (3 - mu) / 2;
  const double s = std::pow(std::sin(psi / 2), 2);
  const double delta = 4 * s / (3 * (n - 1) * (n - 1)), at_pi = 4 / (3 * (n - 1) * (n - 1));
  const double power = std::pow(delta, nu), power_at_pi = std::pow(at_pi, nu);
  return (nu * (1 - delta) - (1 - power) + (delta * (1 - power) - nu * (1 - delta)) / s) /
             (4 * kPi * std::pow(1 - delta, 2) * power) +
         (1 - power_at_pi) * (3 * std::pow(std::cos(psi), 2) - 1) / (16 * kPi * (at_pi - 1) * power_at_pi);
}

TEST(PhaseFunction, HasTheMomentsOfFournierForand) {
  const PhaseFunction function = PhaseFunction::FournierForand(0.0183);
  EXPECT_NEAR(function.BackscatterFraction(), 0.0183, 1e-6);
  // Integrated apart from this code, with the light below 1e-6 rad.
  EXPECT_NEAR(function.MeanCosine(), 0.930004, 2e-5);
  EXPECT_NEAR(function.MeanSecondLegendre(), 0.877219, 2e-5);
  EXPECT_NEAR(function.MeanSquareAngle(), 0.176922, 2e-5);
}

TEST(PhaseFunction, IsTheIntegralOfFournierForand) {
  const PhaseFunction function = PhaseFunction::FournierForand(0.0183);
  for (const auto& [from, to] : {std::pair{0.001, 0.01}, {0.01, 0.3}, {0.3, 1.2}, {1.2, kPi}}) {
    double sum = 0;
    const int steps = 20'000;
    const double step = std::log(to / from) / steps;
    for (int i = 0; i < steps; ++i) {
      const double psi = from * std::exp((i + 0.5) * step);
      sum += 2 * kPi * FournierForandValue(psi) * std::sin(psi) * psi * step;
    }
    EXPECT_NEAR((function.ShareBelow(to) - function.ShareBelow(from)) / sum, 1, 2e-4) << from;
  }
}

TEST(PhaseFunction, HasTheMomentsOfHenyeyGreenstein) {
  const double g = 0.924;
  const PhaseFunction function = PhaseFunction::HenyeyGreenstein(g);
  EXPECT_NEAR(function.MeanCosine(), g, 1e-6);
  EXPECT_NEAR(function.MeanSecondLegendre(), g * g, 1e-6);
  EXPECT_NEAR(function.BackscatterFraction(), (1 - g) / (2 * g) * ((1 + g) / std::sqrt(1 + g * g) - 1), 1e-6);
}

TEST(PhaseFunction, DrawsAnglesOfItsMoments) {
  const PhaseFunction function = PhaseFunction::FournierForand(0.0183);
  UniformStream random(1, 0, 0);
  const int count = 1'000'000;
  double cosine = 0, backwards = 0;
  for (int i = 0; i < count; ++i) {
    const double sin_half = function.SinHalf(random.Next());
    cosine += 1 - 2 * sin_half * sin_half;
    backwards += sin_half > std::sqrt(0.5);
  }
  EXPECT_NEAR(cosine / count, function.MeanCosine(), 1e-3);
  EXPECT_NEAR(backwards / count, 0.0183, 5e-4);
  EXPECT_EQ(function.SinHalf(0), 0);
  EXPECT_NEAR(function.SinHalf(1 - 1e-12), 1, 1e-4);
}

}  // namespace
}  // namespace albtpu
