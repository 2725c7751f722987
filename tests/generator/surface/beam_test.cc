#include "generator/surface/beam.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

#include "tests/degree.h"

namespace albtpu {
namespace {

using albtpu::testing::kDegree;
constexpr int kRays = 20000;

// Mean squares of the coordinates at which rays cross z = 0, along and across the azimuth of the beam.
struct Spread {
  double along, across;
};
Spread SpreadOf(const Beam& beam) {
  const Eigen::Vector2d azimuth = beam.azimuth_direction();
  Spread spread{0, 0};
  for (const Ray& ray : beam.Rays(0)) {
    spread.along += std::pow(ray.at_zero.dot(azimuth), 2) / beam.ray_count();
    spread.across += std::pow(ray.at_zero.dot(Eigen::Vector2d(-azimuth.y(), azimuth.x())), 2) / beam.ray_count();
  }
  return spread;
}

class BeamOfProfile : public ::testing::TestWithParam<BeamProfile> {};
INSTANTIATE_TEST_SUITE_P(, BeamOfProfile, ::testing::Values(BeamProfile::kUniform, BeamProfile::kGaussian),
                         [](const auto& test) { return std::string(Name(test.param)); });

TEST_P(BeamOfProfile, HasThePowerOfItsProfileWithinEveryRadius) {
  constexpr double kFootprint = 0.6;
  const Beam beam({.footprint = kFootprint, .profile = GetParam()}, kRays);
  for (const double radius : {0.05, 0.15, 0.25, 0.299}) {
    int within = 0;
    for (const Ray& ray : beam.Rays(0)) within += ray.at_zero.norm() < radius;
    const double r = radius / kFootprint;
    const double power = GetParam() == BeamProfile::kUniform ? 4 * r * r : 1 - std::exp(-8 * r * r);
    EXPECT_NEAR(within, power * kRays, 1) << radius;
  }
}

// A disc and a gaussian of the same D have the same variance, D^2/16 along each axis. The spiral is uniform down to the
// spacing of its rays, 1/sqrt(rays) of the footprint.
TEST_P(BeamOfProfile, HasTheVarianceOfASixteenthOfItsSquaredDiameter) {
  const Spread spread = SpreadOf(Beam({.footprint = 0.6, .profile = GetParam()}, kRays));
  EXPECT_NEAR(spread.along / (0.36 / 16), 1, 1 / std::sqrt(kRays));
  EXPECT_NEAR(spread.across / (0.36 / 16), 1, 1 / std::sqrt(kRays));
}

TEST_P(BeamOfProfile, HasAnEllipticalFootprintOnTheWater) {
  const double incidence = 40 * kDegree;
  const Spread spread =
      SpreadOf(Beam({.incidence = incidence, .azimuth = 1.1, .footprint = 0.6, .profile = GetParam()}, kRays));
  EXPECT_NEAR(spread.along / (0.36 / 16 / std::pow(std::cos(incidence), 2)), 1, 1 / std::sqrt(kRays));
  EXPECT_NEAR(spread.across / (0.36 / 16), 1, 1 / std::sqrt(kRays));
}

// The rays are a quadrature of the footprint's Fourier transform, with the relative error (kappa spacing)^2 / 24 of the
// midpoint rule: at most 7e-4 where kappa D is 20.
TEST_P(BeamOfProfile, HasRaysWhoseTransformIsThatOfTheFootprint) {
  const BeamOptions options{.incidence = 25 * kDegree, .azimuth = 0.4, .footprint = 0.5, .profile = GetParam()};
  const std::vector<Ray> rays = Beam(options, kRays).Rays(0);
  for (const double k : {0.1, 2.0, 5.0, 10.0, 20.0, 35.0}) {
    for (const double psi : {0.0, 0.4, 1.2, 2.5}) {
      std::complex<double> transform = 0;
      for (const Ray& ray : rays)
        transform += std::polar(1.0 / kRays, k * (ray.at_zero.x() * std::cos(psi) + ray.at_zero.y() * std::sin(psi)));
      EXPECT_NEAR(FootprintPower(options, k, psi), std::norm(transform), 1e-3) << k << " rad/m at " << psi;
    }
  }
}

TEST(Beam, HasParallelRaysWhenCollimated) {
  const double incidence = 20 * kDegree, azimuth = 70 * kDegree;
  const Beam beam({.incidence = incidence, .azimuth = azimuth, .footprint = 1}, 50);
  const Eigen::Vector3d expected(std::sin(incidence) * std::cos(azimuth), std::sin(incidence) * std::sin(azimuth),
                                 -std::cos(incidence));
  for (const Ray& ray : beam.Rays(3)) EXPECT_LT((ray.direction - expected).norm(), 1e-15);
}

TEST(Beam, DivergesFromItsPointSource) {
  constexpr double kHeight = 4, kElevation = 0.3;
  const double incidence = 15 * kDegree;
  const Beam beam({.incidence = incidence, .azimuth = 0, .footprint = 0.25, .source_height = kHeight}, 200);
  for (const double elevation : {0.0, kElevation}) {
    const double above = kHeight - elevation;
    for (const Ray& ray : beam.Rays(elevation)) {
      const Eigen::Vector2d at_source = ray.at_zero + above * ray.per_height();
      EXPECT_LT((at_source - Eigen::Vector2d(-above * std::tan(incidence), 0)).norm(), 1e-14);
      EXPECT_NEAR(ray.direction.norm(), 1, 1e-15);
    }
  }
}

TEST(Beam, NarrowsTowardsItsPointSource) {
  const Beam beam({.footprint = 0.25, .source_height = 4}, 1000);
  const auto radius = [&](double elevation) { return beam.Rays(elevation).back().at_zero.norm(); };
  EXPECT_NEAR(radius(0), 0.125, 0.125 / 1000);  // the outermost of 1000 rays of equal power
  EXPECT_NEAR(radius(1) / radius(0), 0.75, 1e-12);
}

}  // namespace
}  // namespace albtpu
