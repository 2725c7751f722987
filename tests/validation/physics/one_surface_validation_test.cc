// The sea in bands (a patch under the beam, plane waves longer than it, a weight for the place where a slanted beam
// meets them, nothing below the grid) against one surface that holds every wave down to the same grid, with beams at
// many places.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <utility>
#include <vector>

#include "generator/math/statistics.h"
#include "generator/monte_carlo/monte_carlo.h"
#include "generator/surface/ray_tracer.h"
#include "generator/surface/wave_patch.h"
#include "sea/response/closed_form.h"
#include "tests/degree.h"

namespace albtpu {
namespace {

using albtpu::testing::kDegree;
constexpr double kDepth = 10;  // m
constexpr double kFootprint = 0.5, kPointsPerFootprint = 64;
constexpr int kSize = 2048;  // of the one surface: 16 m a side, seven peak wavelengths
constexpr int kSurfaces = 40, kPlaces = 36, kRaysOfPlace = 2000;
const SeaOptions kSea{.waves = WindSea{.wind_speed_10m = 4, .fetch = 2000}};

const std::vector<BeamOptions> kBeams = {{.footprint = kFootprint},
                                         {.incidence = 8 * kDegree, .azimuth = 70 * kDegree, .footprint = kFootprint},
                                         {.incidence = 25 * kDegree, .azimuth = 20 * kDegree, .footprint = kFootprint}};

// The middle part of the surface that `stream` draws, wide enough for all places and rays.
HeightField Middle(const WavePatchModel& model, const NormalStream& stream) {
  const std::vector<double> heights = model.Draw(stream);
  const int points = kSize - 1;
  std::vector<double> middle;
  middle.reserve(static_cast<std::size_t>(points) * points);
  for (int i = 0; i < points; ++i) {
    const auto row = heights.begin() + static_cast<std::ptrdiff_t>(i) * kSize;
    middle.insert(middle.end(), row, row + points);
  }
  return HeightField(std::move(middle), points, model.spacing());
}

// The beams at all places of one surface: sums of the errors (tangent x, y, horizontal x, y, vertical) and of their
// squares.
struct PlaceSums {
  Eigen::Array<double, 5, 1> errors = Eigen::Array<double, 5, 1>::Zero(), squares = errors;
};

PlaceSums AtAllPlaces(const HeightField& surface, const Beam& beam, const UnresolvedWaves& unresolved,
                      const TracedBeam& still, double length) {
  PlaceSums sums;
  for (int place = 0; place < kPlaces; ++place) {
    const Eigen::Vector2d x((place / 6 - 2.5) * length / 7, (place % 6 - 2.5) * length / 7);
    std::vector<Ray> rays = beam.Rays(0);
    for (Ray& ray : rays) ray.at_zero += x;
    const BeamErrors e = ErrorsOf(WithUnresolvedWaves(Trace(rays, surface, kRefractiveIndex), unresolved), still);
    const Eigen::Vector2d horizontal = e.horizontal_offset + kDepth * e.horizontal_per_depth;
    const Eigen::Array<double, 5, 1> errors((Eigen::Array<double, 5, 1>() << std::atan(e.tangent.x()),
                                             std::atan(e.tangent.y()), horizontal.x(), horizontal.y(),
                                             e.vertical_offset + kDepth * e.vertical_per_depth)
                                                .finished());
    sums.errors += errors / kPlaces;
    sums.squares += errors.square() / kPlaces;
  }
  return sums;
}

// 2 sigma of a sum of components. Each surface counts as one sample, because the places on it are correlated.
Estimate TwoSigmaOf(const std::vector<PlaceSums>& surfaces, std::vector<int> components) {
  Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(kSurfaces);
  double variance_of_mean = 0;
  for (const int c : components) {
    Eigen::ArrayXd means(kSurfaces), mean_squares(kSurfaces);
    for (int i = 0; i < kSurfaces; ++i) {
      means[i] = surfaces[i].errors[c];
      mean_squares[i] = surfaces[i].squares[c];
    }
    const double mean = means.mean();
    squares += mean_squares - 2 * mean * means + mean * mean;
    variance_of_mean += std::pow(Mean(means).standard_error, 2);
  }
  return TwoSigmaOfSquares(squares, variance_of_mean);
}

void ExpectAlike(const Estimate& bands, const Estimate& one, const char* what, double incidence) {
  EXPECT_LT(one.standard_error, 0.03 * one.value) << what;
  EXPECT_NEAR(bands.value, one.value, 3.5 * std::hypot(bands.standard_error, one.standard_error))
      << what << " at " << incidence / kDegree << " degrees";
}

TEST(OneSurface, RefractsABeamAsTheSeaInBandsDoes) {
  const SeaState sea(kSea);
  const double spacing = kFootprint / kPointsPerFootprint, length = kSize * spacing;
  const CrossFade all_in_the_patch(1e-6, 2e-6);
  const WavePatchModel model(sea, length, kSize, all_in_the_patch);
  const Eigen::Matrix2d resolved_slopes = model.FacetSlopeCovariance([](double, double) { return 1.0; });
  const Eigen::Matrix2d unresolved_slopes = SlopeCovariance(sea) - resolved_slopes;

  std::vector<std::vector<PlaceSums>> of_beams(kBeams.size(), std::vector<PlaceSums>(kSurfaces));
  tbb::parallel_for(0, kSurfaces, [&](int i) {
    const HeightField surface = Middle(model, NormalStream(9, 0, i));
    for (std::size_t b = 0; b < kBeams.size(); ++b) {
      const Beam beam(kBeams[b], kRaysOfPlace);
      const TracedBeam still = Trace(beam.Rays(0), HeightField(std::vector<double>(9, 0.0), 3, 1.0), kRefractiveIndex);
      of_beams[b][i] = AtAllPlaces(
          surface, beam, EffectOfUnresolvedWaves(kBeams[b], kRefractiveIndex, unresolved_slopes, resolved_slopes),
          still, length);
    }
  });

  SeaCase sea_case;
  sea_case.sea = kSea;
  sea_case.beams = kBeams;
  sea_case.depths = {kDepth};
  sea_case.rays = kRaysOfPlace;
  const SeaCaseResult bands = Simulate(sea_case, {.realizations = 512, .most_realizations = 512}, 9, 1);
  for (std::size_t b = 0; b < kBeams.size(); ++b) {
    const double incidence = kBeams[b].incidence;
    ExpectAlike(bands.beams[b].refraction_along_wind, TwoSigmaOf(of_beams[b], {0}), "refraction along wind", incidence);
    ExpectAlike(bands.beams[b].refraction_cross_wind, TwoSigmaOf(of_beams[b], {1}), "refraction cross wind", incidence);
    ExpectAlike(bands.beams[b].thu[0], TwoSigmaOf(of_beams[b], {2, 3}), "THU", incidence);
    ExpectAlike(bands.beams[b].tvu[0], TwoSigmaOf(of_beams[b], {4}), "TVU", incidence);
  }
}

}  // namespace
}  // namespace albtpu
