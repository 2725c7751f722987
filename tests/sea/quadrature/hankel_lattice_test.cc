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

}  // namespace
}  // namespace albtpu
