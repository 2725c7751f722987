#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "generator/math/random_stream.h"
#include "generator/math/statistics.h"
#include "generator/monte_carlo/slope_moments.h"
#include "generator/surface/sea_surface.h"

namespace albtpu {
namespace {

Eigen::Matrix2d CovarianceOn(const SurfaceModel& model, const BeamOptions& beam, const std::vector<Ray>& rays) {
  const double spacing = model.patch().spacing();
  return HeightSlopeProduct(SurfaceCorrelation(model, ReachOfRays(rays, spacing)), spacing).Covariance(beam);
}

// The points of the grid within the footprint and the shares of their cells, from a finer sample than the tested one.
void PointsWithin(const BeamOptions& beam, double spacing, int reach, std::vector<Eigen::Vector2i>& points,
                  std::vector<double>& shares) {
  constexpr int kSamples = 25;
  const Eigen::Vector2d along(std::cos(beam.azimuth), std::sin(beam.azimuth)), across(-along.y(), along.x());
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      int within = 0;
      for (int s = 0; s < kSamples; ++s) {
        for (int t = 0; t < kSamples; ++t) {
          const Eigen::Vector2d at =
              spacing * Eigen::Vector2d(x + (s + 0.5) / kSamples - 0.5, y + (t + 0.5) / kSamples - 0.5);
          const double radius = std::hypot(at.dot(along) * std::cos(beam.incidence), at.dot(across));
          if (2 * radius < beam.footprint) ++within;
        }
      }
      if (within == 0) continue;
      points.emplace_back(x, y);
      shares.push_back(within);
    }
  }
  double sum = 0;
  for (const double share : shares) sum += share;
  for (double& share : shares) share /= sum;
}

// The slow twin: Wick's theorem over all pairs of pairs of points, as matrix products without a Fourier transform.
TEST(HeightSlopeProduct, EqualsTheSumOverAllPairsOfPairsOfPoints) {
  for (const BeamOptions& beam :
       {BeamOptions{.footprint = 1}, BeamOptions{.incidence = 0.6, .azimuth = 0.7, .footprint = 3}}) {
    const SurfaceModel model(SeaState(6, 2e4), beam, {.patch_per_beam = 4, .points_per_footprint = 24, .rays = 500});
    const double spacing = model.patch().spacing();
    const std::vector<Ray> rays = Beam(beam, 500).Rays(0);
    const SurfaceCorrelation correlation(model, ReachOfRays(rays, spacing));
    std::vector<Eigen::Vector2i> points;
    std::vector<double> shares;
    PointsWithin(beam, spacing, correlation.reach() / 2, points, shares);

    const Eigen::Index n = static_cast<Eigen::Index>(points.size());
    const auto matrix = [&](const Eigen::MatrixXd& of_lag) {  // element (i, j): from i to j
      Eigen::MatrixXd all(n, n);
      for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) {
          const Eigen::Vector2i lag = (points[j] - points[i]).array() + correlation.reach();
          all(i, j) = of_lag(lag.x(), lag.y());
        }
      }
      return all;
    };
    const SurfaceCorrelation::AtPoints& at = correlation.at_points();
    const Eigen::VectorXd w = Eigen::Map<const Eigen::VectorXd>(shares.data(), n);
    const Eigen::MatrixXd k = Eigen::MatrixXd(w.asDiagonal()) - w * w.transpose();
    const Eigen::MatrixXd heights = matrix(at.height);
    const std::array<Eigen::MatrixXd, 2> height_slope = {matrix(at.height_x), matrix(at.height_y)};
    const std::array<std::array<Eigen::MatrixXd, 2>, 2> slopes = {
        {{matrix(at.slope_xx), matrix(at.slope_xy)}, {matrix(at.slope_xy), matrix(at.slope_yy)}}};
    Eigen::Matrix2d expected;
    for (const int a : {0, 1}) {
      for (const int b : {0, 1}) {
        // sum K_ij K_kl (C_ik R_jl + G_b(i to l) G_a(k to j))
        expected(a, b) = (k.transpose() * heights * k * slopes[a][b].transpose()).trace() +
                         (k.transpose() * height_slope[b] * k.transpose() * height_slope[a]).trace();
      }
    }
    const Eigen::Matrix2d covariance = CovarianceOn(model, beam, rays);
    EXPECT_LT((covariance - expected).norm() / expected.norm(), 2e-3) << covariance << "\n\n" << expected;
  }
}

// A footprint narrower than most waves, and one as wide as they are long.
TEST(HeightSlopeProduct, IsTheCovarianceOverManySurfaces) {
  constexpr int kSurfaces = 4000, kRays = 2000;
  const SeaState sea(8, std::numeric_limits<double>::infinity());
  for (const double footprint : {0.3, 4.0}) {
    const BeamOptions options{.incidence = 0.3, .azimuth = 0.6, .footprint = footprint};
    const std::vector<Ray> rays = Beam(options, kRays).Rays(0);
    const SurfaceModel model(sea, options, {.patch_per_beam = 3, .points_per_footprint = 32, .rays = kRays});
    const Beam vertical({.footprint = footprint}, 1);  // meets all sides of the waves equally often
    Eigen::ArrayX3d squares(kSurfaces, 3);
    for (int i = 0; i < kSurfaces; ++i) {
      const HeightField surface = SeaSurface(model, NormalStream(4, 0, i)).SurfaceUnder(vertical).heights;
      double height = 0;
      Eigen::Vector2d slope = Eigen::Vector2d::Zero(), product = Eigen::Vector2d::Zero();
      for (const Ray& ray : rays) {
        const HeightField::Facet facet = surface.FacetAt(ray.at_zero);
        height += facet.HeightAt(ray.at_zero) / kRays;
        slope += facet.slope / kRays;
        product += facet.HeightAt(ray.at_zero) * facet.slope / kRays;
      }
      const Eigen::Vector2d q = product - height * slope;
      squares.row(i) << q.x() * q.x(), q.x() * q.y(), q.y() * q.y();
    }
    const Eigen::Matrix2d expected = CovarianceOn(model, options, rays);
    const std::array<double, 3> elements = {expected(0, 0), expected(0, 1), expected(1, 1)};
    for (int e = 0; e < 3; ++e) {
      const Estimate mean = Mean(squares.col(e));
      // The rays only sample the footprint, which adds a little aliased variance.
      const double aliased = e == 1 ? 0 : 0.01 * elements[e];
      EXPECT_NEAR(mean.value, elements[e], 4 * mean.standard_error + aliased) << footprint << ' ' << e;
    }
  }
}

}  // namespace
}  // namespace albtpu
