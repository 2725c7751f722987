#include <gtest/gtest.h>

#include <cmath>

#include "sea/quadrature/hankel_lattice.h"
#include "sea/response/sea_response.h"

namespace albtpu {
namespace {

BeamResponse Example() {
  BeamResponse beam;
  beam.covariance_per_depth << 4e-4, 1e-5, 2e-5, 1e-5, 3e-4, 0, 2e-5, 0, 9e-6;
  beam.covariance_at_surface << 1e-6, 0, 0, 0, 2e-6, 0, 0, 0, 1e-8;
  beam.mean_per_depth << 0.003, -0.004, 0.002;
  beam.azimuth << 0.6, 0.8;
  return beam;
}

TEST(BeamResponse, AddsTheVariancesOfSurfaceAndDepth) {
  EXPECT_DOUBLE_EQ(Example().Thu(0), 2 * std::sqrt(3e-6));
  EXPECT_DOUBLE_EQ(Example().Thu(10), 2 * std::sqrt(100 * 7e-4 + 3e-6));
  EXPECT_DOUBLE_EQ(Example().Tvu(10), 2 * std::sqrt(100 * 9e-6 + 1e-8));
}

TEST(BeamResponse, TakesTheBiasAlongTheBeam) {
  EXPECT_NEAR(Example().BiasAlongBeam(10), 10 * (0.6 * 0.003 - 0.8 * 0.004), 1e-15);
  EXPECT_DOUBLE_EQ(Example().BiasVertical(10), 0.02);
}

// The next order is some 10 K^2.
TEST(BeamResponse, HasTheDeviationOfTheAngleOfANormalTangent) {
  const BeamResponse beam = Example();
  double mean = 0, squares = 0;
  for (const auto& [at, weight] : GaussHermite(20)) {
    const double angle = std::atan(beam.mean_per_depth.x() + std::sqrt(beam.covariance_per_depth(0, 0)) * at);
    mean += weight * angle;
    squares += weight * angle * angle;
  }
  EXPECT_NEAR(beam.refraction_along_wind() / (2 * std::sqrt(squares - mean * mean)), 1, 10 * 4e-4 * 4e-4);
}

}  // namespace
}  // namespace albtpu
