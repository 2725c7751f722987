#include <gtest/gtest.h>

#include <cmath>

#include "sea/quadrature/hankel_lattice.h"

namespace albtpu {
namespace {

constexpr double kRounding = 1e-13;

template <typename Function>
double Sum(const std::vector<QuadratureNode>& nodes, const Function& f) {
  double sum = 0;
  for (const auto& [at, weight] : nodes) sum += weight * f(at);
  return sum;
}

TEST(GaussLegendre, IntegratesPolynomialsUpToItsDegree) {
  const auto nodes = GaussLegendre(5, 1, 3);
  for (int degree = 0; degree <= 9; ++degree) {
    const double exact = (std::pow(3, degree + 1) - 1) / (degree + 1);
    EXPECT_NEAR(Sum(nodes, [&](double x) { return std::pow(x, degree); }) / exact, 1, kRounding) << degree;
  }
}

// The even moments of the standard normal distribution are 1, 3, 15, ... = (2n - 1)!!.
TEST(GaussHermite, HasTheMomentsOfTheNormalDistribution) {
  const auto nodes = GaussHermite(10);
  double moment = 1;
  for (int n = 0; n <= 9; ++n) {
    EXPECT_NEAR(Sum(nodes, [&](double x) { return std::pow(x, 2 * n); }) / moment, 1, 10 * kRounding) << n;
    EXPECT_NEAR(Sum(nodes, [&](double x) { return std::pow(x, 2 * n + 1); }) / moment, 0, 100 * kRounding);
    moment *= 2 * n + 1;
  }
}

// The integral of x^n exp(-x) is n!.
TEST(GaussLaguerre, HasTheMomentsOfTheExponentialDistribution) {
  const auto nodes = GaussLaguerre(8);
  double factorial = 1;
  for (int n = 0; n <= 15; ++n) {
    EXPECT_NEAR(Sum(nodes, [&](double x) { return std::pow(x, n); }) / factorial, 1, 10 * kRounding) << n;
    factorial *= n + 1;
  }
}

}  // namespace
}  // namespace albtpu
