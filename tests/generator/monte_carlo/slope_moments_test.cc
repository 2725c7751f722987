#include "generator/monte_carlo/slope_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "generator/math/random_stream.h"
#include "generator/math/statistics.h"
#include "generator/surface/sea_surface.h"
#include "sea/response/closed_form.h"

namespace albtpu {
namespace {

const Eigen::Matrix2d kForm = (Eigen::Matrix2d() << 1, 0.4, 0.4, 0.7).finished();

SlopeMoments MomentsOn(const SurfaceModel& model, const std::vector<Ray>& rays) {
  const double spacing = model.patch().spacing();
  return MomentsOfSlopes(SurfaceCorrelation(model, ReachOfRays(rays, spacing)), rays, spacing, kForm);
}

Eigen::Matrix2d CovarianceOn(const SurfaceModel& model, const BeamOptions& beam, const std::vector<Ray>& rays) {
  const double spacing = model.patch().spacing();
  return HeightSlopeProduct(SurfaceCorrelation(model, ReachOfRays(rays, spacing)), spacing).Covariance(beam);
}

double Form(const Eigen::Vector3d& squares) {
  return kForm(0, 0) * squares[0] + kForm(1, 1) * squares[1] + 2 * kForm(0, 1) * squares[2];
}

// A footprint narrower than most waves, where squares of slopes are nearly chi-squared, and one that averages over many
// waves.
TEST(SlopeMoments, AndProductsWithTheHeightAreThoseOfManySurfaces) {
  constexpr int kSurfaces = 800, kRays = 2000;
  const SeaState sea(8, std::numeric_limits<double>::infinity());
  for (const double footprint : {0.2, 3.0}) {
    const BeamOptions options{.incidence = 0.3, .azimuth = 0.6, .footprint = footprint};
    const std::vector<Ray> rays = Beam(options, kRays).Rays(0);
    const SurfaceModel model(sea, options, {.patch_per_beam = 3, .points_per_footprint = 32, .rays = kRays});
    const Beam vertical({.footprint = footprint}, 1);  // meets all sides of the waves equally often
    Eigen::ArrayX2d means(kSurfaces, 2);
    Eigen::ArrayX3d products(kSurfaces, 3);
    Eigen::ArrayXd forms(kSurfaces);
    for (int i = 0; i < kSurfaces; ++i) {
      const HeightField surface = SeaSurface(model, NormalStream(4, 0, i)).SurfaceUnder(vertical).heights;
      double height = 0;
      Eigen::Vector2d slope = Eigen::Vector2d::Zero(), product = Eigen::Vector2d::Zero();
      Eigen::Vector3d squares = Eigen::Vector3d::Zero();
      for (const Ray& ray : rays) {
        const HeightField::Facet facet = surface.FacetAt(ray.at_zero);
        height += facet.HeightAt(ray.at_zero) / kRays;
        slope += facet.slope / kRays;
        squares += SlopeSquares(facet.slope) / kRays;
        product += facet.HeightAt(ray.at_zero) * facet.slope / kRays;
      }
      means.row(i) = slope.transpose().array();
      forms[i] = Form(squares);
      const Eigen::Vector2d q = product - height * slope;
      products.row(i) << q.x() * q.x(), q.x() * q.y(), q.y() * q.y();
    }
    const SlopeMoments moments = MomentsOn(model, rays);
    const Eigen::Matrix2d& expected = moments.covariance;
    const Eigen::Matrix2d covariance = means.matrix().transpose() * means.matrix() / kSurfaces;
    for (const int a : {0, 1}) {
      for (const int b : {0, 1}) {  // the standard error for a normal sample is sqrt((v_a v_b + c^2) / n)
        const double scatter = expected(a, a) * expected(b, b) + std::pow(expected(a, b), 2);
        EXPECT_NEAR(covariance(a, b), expected(a, b), 4 * std::sqrt(scatter / kSurfaces)) << footprint;
      }
    }
    const Estimate mean = Mean(forms), spread = TwoSigma(forms);
    EXPECT_NEAR(mean.value, Form(moments.expected_squares), 4 * mean.standard_error) << footprint;
    EXPECT_NEAR(spread.value, 2 * std::sqrt(moments.variance_of_form), 4 * spread.standard_error) << footprint;
    const Eigen::Matrix2d of_products = CovarianceOn(model, options, rays);
    const std::array<double, 3> elements = {of_products(0, 0), of_products(0, 1), of_products(1, 1)};
    for (int e = 0; e < 3; ++e) {
      const Estimate product = Mean(products.col(e));
      // The rays only sample the footprint, which adds a little aliased variance.
      const double aliased = e == 1 ? 0 : 0.01 * elements[e];
      EXPECT_NEAR(product.value, elements[e], 4 * product.standard_error + aliased) << footprint << ' ' << e;
    }
  }
}

// The slope, along x and y, of the facet where a ray crosses z = 0, as weights of the heights of the local surface.
std::array<Eigen::MatrixXd, 2> FacetSlope(const SurfaceModel& model, const Ray& ray) {
  const int points = model.local_points();
  const double spacing = model.patch().spacing();
  const auto [ix, iy, beside_x] = model.StillSurface().TriangleAt(ray.at_zero);
  std::array<Eigen::MatrixXd, 2> weights = {Eigen::MatrixXd::Zero(points, points),
                                            Eigen::MatrixXd::Zero(points, points)};
  const int along_x = beside_x ? iy : iy + 1, along_y = beside_x ? ix + 1 : ix;
  weights[0](ix + 1, along_x) += 1 / spacing;
  weights[0](ix, along_x) -= 1 / spacing;
  weights[1](along_y, iy + 1) += 1 / spacing;
  weights[1](along_y, iy) -= 1 / spacing;
  return weights;
}

// The covariance of two linear functionals of the local surface, each a sum of weights (ix is the row) times heights,
// from the modes of the patch and from the plane waves as they are interpolated.
double Covariance(const SurfaceModel& model, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const int size = model.patch().size();
  const auto of_patch = [&](const Eigen::MatrixXd& weights) {
    Eigen::MatrixXd folded = Eigen::MatrixXd::Zero(size, size);  // the patch repeats
    for (Eigen::Index i = 0; i < weights.rows(); ++i)
      for (Eigen::Index j = 0; j < weights.cols(); ++j) folded(i % size, j % size) += weights(i, j);
    return ForwardFft(folded);
  };
  const Eigen::MatrixXcd patch_a = of_patch(a), patch_b = of_patch(b);
  double sum = 0;
  for (int row = 0; row < size; ++row)
    for (int j = 0; j < size / 2; ++j)
      sum += (j == 0 ? 1 : 2) * model.patch().power(row, j) * (patch_a(row, j) * std::conj(patch_b(row, j))).real();
  const auto of_long_waves = [&](const Eigen::MatrixXd& weights) {
    const Eigen::MatrixXd at_nodes = model.refinement().transpose() * weights * model.refinement();
    return Eigen::VectorXcd((at_nodes * model.phases_y()).cwiseProduct(model.phases_x()).colwise().sum().transpose());
  };
  const Eigen::VectorXcd long_a = of_long_waves(a), long_b = of_long_waves(b);
  for (Eigen::Index m = 0; m < long_a.size(); ++m)
    sum += model.long_waves().waves()[m].variance * (long_a[m] * std::conj(long_b[m])).real();
  return sum;
}

// The slow twin: the covariance of the slopes of every pair of rays. The two differ only by the interpolation of the
// plane waves.
TEST(SlopeMoments, EqualTheSumsOverAllPairsOfRays) {
  struct Case {
    double wind_speed, fetch;
    BeamOptions beam;
  };
  for (const auto& [wind_speed, fetch, options] :
       {Case{2, 1e3, {.footprint = 0.25}}, Case{2, INFINITY, {.incidence = 0.4, .azimuth = 0.5, .footprint = 2}},
        Case{12, INFINITY, {.incidence = 0.1, .azimuth = 1.2, .footprint = 0.5}}}) {
    const SeaState sea(wind_speed, fetch);
    const std::vector<Ray> rays = Beam(options, 12).Rays(0);
    const SurfaceModel model(sea, options, {.patch_per_beam = 2.5, .points_per_footprint = 64, .rays = 12});
    std::vector<std::array<Eigen::MatrixXd, 2>> slopes;
    for (const Ray& ray : rays) slopes.push_back(FacetSlope(model, ray));
    const double weight = 1.0 / static_cast<double>(rays.size() * rays.size());
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
    double variance_of_form = 0;
    for (const auto& a : slopes) {
      for (const auto& b : slopes) {
        Eigen::Matrix2d r;
        for (const int i : {0, 1})
          for (const int j : {0, 1}) r(i, j) = Covariance(model, a[i], b[j]);
        covariance += weight * r;
        variance_of_form += 2 * weight * (kForm * r * kForm * r.transpose()).trace();
      }
    }
    const SlopeMoments moments = MomentsOn(model, rays);
    EXPECT_LT((moments.covariance - covariance).norm() / covariance.norm(), 2e-4) << wind_speed << ' ' << fetch;
    EXPECT_NEAR(moments.variance_of_form / variance_of_form, 1, 4e-4) << wind_speed << ' ' << fetch;
  }
}

// The test compares a sum over lags with a sum over waves, on the same facets and plane waves.
TEST(SlopeMoments, OfAFootprintAreThoseOfTheFilteredWaves) {
  const SeaState sea(6, 2e4);
  for (const BeamOptions& options :
       {BeamOptions{.footprint = 0.3}, BeamOptions{.incidence = 0.4, .azimuth = 0.7, .footprint = 1.5},
        BeamOptions{.incidence = 0.2, .azimuth = 1.2, .footprint = 0.6, .profile = BeamProfile::kGaussian}}) {
    const SurfaceModel model(sea, options, {.patch_per_beam = 2.5, .points_per_footprint = 64, .rays = 4000});
    const double spacing = model.patch().spacing();
    const SurfaceCorrelation correlation(model, ReachOfRays(Beam(options, 4000).Rays(0), spacing));
    const Eigen::Matrix2d expected =
        model.FacetSlopeCovariance([&](double k, double psi) { return FootprintPower(options, k, psi); });
    const Eigen::Matrix2d covariance = FootprintSlopeCovariance(correlation, options, spacing);
    EXPECT_LT((covariance - expected).norm() / expected.norm(), 1e-3) << options.footprint;
  }
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

}  // namespace
}  // namespace albtpu
