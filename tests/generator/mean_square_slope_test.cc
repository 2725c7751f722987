#include "generator/mean_square_slope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "generator/random_stream.h"
#include "generator/statistics.h"

namespace albtpu {
namespace {

// A footprint narrower than most waves, where |slope|^2 is nearly chi-squared, and one that averages over many.
TEST(MeanSquareSlope, HasItsMomentsOverManySurfaces) {
  constexpr int kSurfaces = 4000;
  const SeaState sea(8, std::numeric_limits<double>::infinity());
  for (const double footprint : {0.1, 1.5}) {
    const BeamOptions options{.footprint = footprint};
    const Beam beam(options, 500);
    const std::vector<Ray> rays = beam.Rays(0);
    const SurfaceModel model(sea, options, {.patch_per_beam = 3, .points_per_footprint = 24, .rays = 500});
    Eigen::ArrayXd squares(kSurfaces);
    for (int i = 0; i < kSurfaces; ++i) {
      const HeightField window = SeaSurface(model, NormalStream(4, 0, i)).WindowUnder(beam).heights;
      double sum = 0;
      for (const Ray& ray : rays) sum += window.FacetAt(ray.at_zero).slope.squaredNorm();
      squares[i] = sum / static_cast<double>(rays.size());
    }
    const auto [mean, variance] = MomentsOfMeanSquareSlope(model, rays);
    const Estimate sampled = Mean(squares), spread = TwoSigma(squares);
    EXPECT_NEAR(sampled.value, mean, 4 * sampled.standard_error) << footprint;
    EXPECT_NEAR(spread.value, 2 * std::sqrt(variance), 4 * spread.standard_error) << footprint;
  }
}

// One ray: |slope|^2 of a Gaussian slope with the covariance C has the mean tr C and the variance 2 tr C^2.
TEST(MeanSquareSlope, OfOneRayIsThatOfTwoGaussianNumbers) {
  const SeaState sea(8, std::numeric_limits<double>::infinity());
  const BeamOptions options{.footprint = 0.5};
  const SurfaceModel model(sea, options, {.patch_per_beam = 3, .points_per_footprint = 24, .rays = 500});
  const Eigen::Matrix2d covariance = model.FacetSlopeCovariance([](double, double) { return 1.0; });
  const auto [mean, variance] = MomentsOfMeanSquareSlope(model, Beam(options, 1).Rays(0));
  EXPECT_NEAR(mean / covariance.trace(), 1, 1e-12);
  EXPECT_NEAR(variance / (2 * (covariance * covariance).trace()), 1, 1e-3);
}

}  // namespace
}  // namespace albtpu
