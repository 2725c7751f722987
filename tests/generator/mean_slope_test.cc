#include "generator/mean_slope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "generator/random_stream.h"

namespace albtpu {
namespace {

constexpr double kFullyDeveloped = std::numeric_limits<double>::infinity();

struct Case {
  Case(double wind_speed, const BeamOptions& options)
      : sea(wind_speed, kFullyDeveloped),
        beam(options, 500),
        rays(beam.Rays(0)),
        model(sea, options, {.patch_per_beam = 3, .points_per_footprint = 24, .rays = 500}),
        mean_slope(model, beam, rays) {}

  SeaState sea;
  Beam beam;
  std::vector<Ray> rays;
  SurfaceModel model;
  MeanSlope mean_slope;
};

TEST(MeanSlope, IsTheMeanOverTheRays) {
  const Case slanted(6, {.incidence = 0.3, .azimuth = 0.7, .footprint = 0.4});
  for (const std::uint32_t realization : {0, 1, 2}) {
    const HeightField window =
        SeaSurface(slanted.model, NormalStream(1, 0, realization)).WindowUnder(slanted.beam).heights;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Ray& ray : slanted.rays) sum += window.FacetAt(ray.at_zero).slope;
    EXPECT_LT((slanted.mean_slope(window) - sum / slanted.rays.size()).norm(), 1e-13);
  }
}

// A slanted line meets the side of the long waves that faces it more often: at 12 m/s and 34 degrees by some 4 % of
// the deviation, where 1.6 % is one standard error.
TEST(MeanSlope, HasItsMomentsOverManySurfaces) {
  constexpr int kSurfaces = 4000;
  for (const double incidence : {0.0, 0.6}) {
    const Case windy(12, {.incidence = incidence, .azimuth = 0.5, .footprint = 0.25});
    Eigen::ArrayX2d slopes(kSurfaces, 2);
    for (int i = 0; i < kSurfaces; ++i) {
      const SeaSurface surface(windy.model, NormalStream(2, 0, i));
      slopes.row(i) = windy.mean_slope(surface.WindowUnder(windy.beam).heights).transpose().array();
    }
    const Eigen::Vector2d mean = slopes.colwise().mean().transpose();
    const Eigen::MatrixX2d deviations = slopes.matrix().rowwise() - mean.transpose();
    const Eigen::Matrix2d covariance = deviations.transpose() * deviations / (kSurfaces - 1);
    const Eigen::Matrix2d& expected = windy.mean_slope.covariance();
    for (const int a : {0, 1}) {
      EXPECT_NEAR(mean[a], windy.mean_slope.mean()[a], 4 * std::sqrt(expected(a, a) / kSurfaces))
          << incidence;
      for (const int b : {0, 1}) {  // of a normal sample, sqrt((v_a v_b + c^2) / n)
        const double scatter = expected(a, a) * expected(b, b) + std::pow(expected(a, b), 2);
        EXPECT_NEAR(covariance(a, b), expected(a, b), 4 * std::sqrt(scatter / kSurfaces)) << incidence;
      }
    }
    EXPECT_EQ(windy.mean_slope.mean().norm() > 0.03 * std::sqrt(expected.trace()), incidence > 0);
  }
}

}  // namespace
}  // namespace albtpu
