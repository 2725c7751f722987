#include "generator/mean_square_slope.h"

#include <gtest/gtest.h>

#include <array>
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

// The slope of the facet over which a ray crosses z = 0, along x and y, as weights of the heights of the window.
std::array<Eigen::MatrixXd, 2> FacetSlope(const SurfaceModel& model, const Ray& ray) {
  const int points = model.window_points();
  const double spacing = model.patch().spacing();
  const HeightField grid(std::vector<double>(static_cast<std::size_t>(points) * points, 0.0), points,
                         spacing);
  const auto [ix, iy, beside_x] = grid.TriangleAt(ray.at_zero);
  std::array<Eigen::MatrixXd, 2> weights = {Eigen::MatrixXd::Zero(points, points),
                                            Eigen::MatrixXd::Zero(points, points)};
  const int along_x = beside_x ? iy : iy + 1, along_y = beside_x ? ix + 1 : ix;
  weights[0](ix + 1, along_x) += 1 / spacing;
  weights[0](ix, along_x) -= 1 / spacing;
  weights[1](along_y, iy + 1) += 1 / spacing;
  weights[1](along_y, iy) -= 1 / spacing;
  return weights;
}

// The slow twin: the covariance of the slopes of every pair of rays, exactly. What is left is the interpolation of the
// long waves, right to 0.3 % amid the cross-fade (sea_surface.cc), about its mean.
TEST(MeanSquareSlope, IsTheSumOverAllPairsOfRays) {
  struct Case {
    double wind_speed, fetch, footprint;
  };
  for (const auto& [wind_speed, fetch, footprint] :
       {Case{2, 1e3, 0.25}, Case{2, INFINITY, 2}, Case{12, INFINITY, 0.5}}) {
    const SeaState sea(wind_speed, fetch);
    const BeamOptions options{.footprint = footprint};
    const std::vector<Ray> rays = Beam(options, 12).Rays(0);
    const SurfaceModel model(sea, options, {.patch_per_beam = 2.5, .points_per_footprint = 64, .rays = 12});
    std::vector<std::array<Eigen::MatrixXd, 2>> slopes;
    for (const Ray& ray : rays) slopes.push_back(FacetSlope(model, ray));
    double mean = 0, variance = 0;
    for (std::size_t a = 0; a < rays.size(); ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        for (const int i : {0, 1}) {
          for (const int j : {0, 1}) {
            const double covariance =
                model.MomentsOf({slopes[a][i], slopes[b][j]}, Eigen::Vector2d::Zero()).covariance(0, 1);
            variance += (a == b ? 2 : 4) * covariance * covariance / (rays.size() * rays.size());
            if (a == b && i == j) mean += covariance / rays.size();
          }
        }
      }
    }
    const MeanSquareSlopeMoments moments = MomentsOfMeanSquareSlope(model, rays);
    EXPECT_NEAR(moments.mean / mean, 1, 1e-10) << wind_speed << ' ' << footprint;
    EXPECT_NEAR(moments.variance / variance, 1, 5e-4) << wind_speed << ' ' << footprint;
  }
}

}  // namespace
}  // namespace albtpu
