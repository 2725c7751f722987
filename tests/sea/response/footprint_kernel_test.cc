#include "sea/response/footprint_kernel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

double LagOf(int j) { return HankelLattice::Shared().Lag(j * FootprintKernel::kLagStride); }

// Trapezoids in steps of 10 %, and the 1e-3 of a gaussian beam's overlap that lies beyond its last lag.
TEST(FootprintKernel, HasAnOverlapOfUnitIntegral) {
  for (const BeamProfile profile : kProfiles)
    for (const double diameter : {0.1, 0.7, 5.0})
      EXPECT_NEAR(FootprintKernel(profile, diameter).overlap().sum(), 1, 1e-3) << Name(profile) << diameter;
}

// Two points of a uniform disc are sqrt(D^2 / 4) apart in the root mean square, 1/4 = 2 * 1/8 D^2; of a gaussian beam,
// whose points have the variance D^2 / 16 on each axis, also 2 * 2 / 16.
TEST(FootprintKernel, HasTheMeanSquareDistanceOfTwoPoints) {
  for (const BeamProfile profile : kProfiles) {
    const FootprintKernel kernel(profile, 0.7);
    double sum = 0;
    for (Eigen::Index j = 0; j < kernel.overlap().size(); ++j) sum += kernel.overlap()[j] * std::pow(LagOf(j), 2);
    EXPECT_NEAR(sum / (0.7 * 0.7 / 4), 1, 2e-3) << Name(profile);
  }
}

// With f = x^2 the mean over a turn of f is s^2 / 2 and of f exp(2 i beta) s^2 / 4; the derivatives are 2 everywhere.
// With f = x^4 they are 3/8 s^4 and 1/4 s^4, and the derivative 12 x^2 has the mean 12 times that of x^2, which is half
// the mean square distance of two points.
TEST(FootprintKernel, TakesTheMeanOfSecondDerivativesOverThePairsOfPoints) {
  for (const BeamProfile profile : kProfiles) {
    constexpr double kDiameter = 0.7;
    const FootprintKernel kernel(profile, kDiameter);
    const auto integrals = [&](double power, double mean, double turned) {
      double on_edge = 0, slope_on_edge = 0;
      for (Eigen::Index j = 0; j < kernel.overlap().size(); ++j) {
        on_edge += kernel.overlap_edge()[j] * std::pow(LagOf(static_cast<int>(j)), power);
        slope_on_edge += kernel.overlap_edge_slope()[j] * std::pow(LagOf(static_cast<int>(j)), power);
      }
      return std::pair(mean * slope_on_edge, turned * (2 * on_edge + slope_on_edge));
    };
    const auto [trace2, difference2] = integrals(2, 1.0 / 2, 1.0 / 4);
    EXPECT_NEAR(trace2 / 2, 1, 1e-4) << Name(profile);
    EXPECT_NEAR(difference2 / 2, 1, 1e-4) << Name(profile);
    const auto [trace4, difference4] = integrals(4, 3.0 / 8, 1.0 / 4);
    const double exact = 12 * kDiameter * kDiameter / 8;
    EXPECT_NEAR(trace4 / exact, 1, 3e-4) << Name(profile);
    EXPECT_NEAR(difference4 / exact, 1, 3e-4) << Name(profile);
  }
}

// On the edge of a uniform disc D' of one wave is 1 - W cos(kappa . s); its mean over a turn is 1 - W J_0(kappa s),
// with the derivative kappa s W J_1(kappa s).
TEST(FootprintKernel, KnowsTheHeightDifferencesOnTheEdgeOfAUniformDisc) {
  constexpr double kDiameter = 0.7;
  const FootprintKernel kernel(BeamProfile::kUniform, kDiameter);
  ASSERT_EQ(kernel.irradiance_rings().size(), 1);
  const SpectrumRing& ring = kernel.irradiance_rings()[0];
  EXPECT_DOUBLE_EQ(ring.weight, 8 / (kDiameter * kDiameter));
  for (int i = 0; i < HankelLattice::Shared().size(); ++i) {
    const double k = HankelLattice::Shared().wavenumbers()[i], x = k * kDiameter / 2, w = kernel.average()[i];
    // Waves whose phase on the edge turns by more than a radian in a step are averaged.
    if (HankelLattice::Shared().step() * x > 1) break;
    const double allowed = std::pow(HankelLattice::Shared().step() * std::max(x, 2.0), 4);
    EXPECT_NEAR(k * k * ring.value(i, 0) / (1 - w * ::j0(x)), 1, allowed) << k;
    EXPECT_NEAR(k * k * ring.slope(i, 0), x * w * ::j1(x), allowed * x * x * std::abs(w) + 1e-7) << k;
  }
}

}  // namespace
}  // namespace albtpu
