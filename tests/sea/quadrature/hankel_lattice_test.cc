#include "sea/quadrature/hankel_lattice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace albtpu {
namespace {

const HankelLattice& Lattice() { return HankelLattice::Shared(); }

TEST(HankelLattice, FindsLagsByTheirIndices) {
  EXPECT_DOUBLE_EQ(Lattice().Lag(0), HankelLattice::kShortestLag);
  EXPECT_NEAR(Lattice().IndexOfLag(Lattice().Lag(100)), 100, 1e-10);
  EXPECT_NEAR(std::log(Lattice().wavenumbers()[1] / Lattice().wavenumbers()[0]), Lattice().step(), 1e-12);
}

// The integral of k^(l + 1) exp(-p^2 k^2) J_l(k s) d(k) has the closed form s^l (2 p^2)^(-l - 1) exp(-s^2 / (4 p^2))
// (Weber's second exponential integral). Interpolation by cubics in ln k errs by the fourth power of the step times the
// fourth derivative by ln k, some (l + 2)^4 of the integrand: 0.15 % for l = 2 before its factor, which is below 1/10.
TEST(HankelLattice, TransformsAGaussian) {
  constexpr double kWidth = 0.3;  // p, m
  const Eigen::ArrayXd k = Lattice().wavenumbers();
  constexpr int kFirst = 60, kCount = 60;  // lags of some cm to m
  for (const int l : {0, 1, 2}) {
    const Eigen::ArrayXd spectrum = Lattice().step() * k.pow(l + 2) * (-kWidth * kWidth * k * k).exp();
    const Eigen::VectorXd transform = Lattice().Bessel(l, kFirst, kCount, 1).cast<double>() * spectrum.matrix();
    const double scale = std::pow(2 * kWidth * kWidth, -l - 1);
    for (int j = 0; j < kCount; ++j) {
      const double s = Lattice().Lag(kFirst + j);
      const double exact = scale * std::pow(s, l) * std::exp(-s * s / (4 * kWidth * kWidth));
      const double greatest = scale * std::pow(2 * kWidth, l);
      EXPECT_NEAR(transform[j], exact, 2e-4 * greatest) << "order " << l << ", lag " << s;
    }
  }
}

TEST(HankelLattice, KeepsTheDigitsOfOneMinusBesselAtShortLags) {
  const auto kernel = Lattice().OneMinusBessel(0, 1, 1);
  const double x = Lattice().wavenumbers()[0] * HankelLattice::kShortestLag;
  EXPECT_NEAR(kernel(0, 0) / (x * x / 4), 1, 2 * std::pow(2 * Lattice().step(), 4));
}

TEST(HankelLattice, TakesEveryStrideThLag) {
  const auto all = Lattice().Bessel(2, 4, 7, 1), every_third = Lattice().Bessel(2, 4, 3, 3);
  for (int j = 0; j < 3; ++j) EXPECT_EQ(every_third.row(j), all.row(3 * j));
}

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
