#include "generator/monte_carlo/slope_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "generator/math/random_stream.h"
#include "generator/math/statistics.h"
#include "sea/response/closed_form.h"

namespace albtpu {
namespace {

const Eigen::Matrix2d kForm = (Eigen::Matrix2d() << 1, 0.4, 0.4, 0.7).finished();

SlopeMoments MomentsOn(const SurfaceModel& model, const std::vector<Ray>& rays) {
  const double spacing = model.patch().spacing();
  return MomentsOfSlopes(SurfaceCorrelation(model, ReachOfRays(rays, spacing)), rays, spacing, kForm);
}

double Form(const Eigen::Vector3d& squares) {
  return kForm(0, 0) * squares[0] + kForm(1, 1) * squares[1] + 2 * kForm(0, 1) * squares[2];
}

// A footprint narrower than most waves, where squares of slopes are nearly chi-squared, and one that averages over many
// waves.
TEST(SlopeMoments, AreThoseOfManySurfaces) {
  constexpr int kSurfaces = 4000;
  const SeaState sea(8, std::numeric_limits<double>::infinity());
  for (const double footprint : {0.1, 1.5}) {
    const BeamOptions options{.incidence = 0.3, .azimuth = 0.6, .footprint = footprint};
    const std::vector<Ray> rays = Beam(options, 500).Rays(0);
    const SurfaceModel model(sea, options, {.patch_per_beam = 3, .points_per_footprint = 24, .rays = 500});
    const Beam vertical({.footprint = footprint}, 1);  // meets all sides of the waves equally often
    Eigen::ArrayX2d means(kSurfaces, 2);
    Eigen::ArrayXd forms(kSurfaces);
    for (int i = 0; i < kSurfaces; ++i) {
      const HeightField surface = SeaSurface(model, NormalStream(4, 0, i)).SurfaceUnder(vertical).heights;
      Eigen::Vector2d slope = Eigen::Vector2d::Zero();
      Eigen::Vector3d squares = Eigen::Vector3d::Zero();
      for (const Ray& ray : rays) {
        slope += surface.FacetAt(ray.at_zero).slope / static_cast<double>(rays.size());
        squares += SlopeSquares(surface.FacetAt(ray.at_zero).slope) / static_cast<double>(rays.size());
      }
      means.row(i) = slope.transpose().array();
      forms[i] = Form(squares);
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

}  // namespace
}  // namespace albtpu
