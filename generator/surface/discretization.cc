#include "generator/surface/discretization.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace albtpu {
namespace {

// Limits on variances. A reported deviation is the square root of a variance: half a per cent of variance is a quarter
// of a per cent of the result. convergence_validation_test checks what comes out.
constexpr double kGridLoss = 0.004;
constexpr double kPatchDeparture = 0.005;
// AliasedSlopeVariance finds about half of the variance that doubling the rays was observed to remove.
constexpr double kAliasedFraction = 0.0075;
// The search starts at values that suffice for footprints narrower than the waves. Its ends limit the cost for
// footprints over which the waves nearly average out.
constexpr double kNarrowestPatch = 2.5, kWidestPatch = 8;    // widths of the beam
constexpr double kCoarsestPoints = 64, kFinestPoints = 256;  // along the footprint
// Vertical errors at nadir depend on the squares of the slopes, which few rays sample too coarsely: 1000 rays were
// observed to add 3 % to these errors, 4000 rays add 0.1 %.
constexpr int kFewestRays = 4000;

// The fraction of the slope variance over the footprint that is lost on facets with the side `spacing` [m]: all of the
// waves shorter than two facets, and of the others the difference between slope and difference quotient.
double GridLoss(const SeaState& sea, const BeamOptions& beam, double spacing, double seen) {
  const Eigen::Matrix2d facets = SlopeCovariance(sea, [&](double k, double psi) {
    const double x = k * std::cos(psi) * spacing / 2, y = k * std::sin(psi) * spacing / 2;
    if (std::max(std::abs(x), std::abs(y)) > std::numbers::pi / 2) return 0.0;
    const double quotient = (std::pow(std::sin(x), 2) + std::pow(std::sin(y), 2)) / (x * x + y * y);
    return FootprintPower(beam, k, psi) * quotient;
  });
  return 1 - facets.trace() / seen;
}

// The variance of a beam's mean slope that comes from waves too short for the spacing of its rays: each ray sees them
// independently, so it is their slope variance over the number of rays. A square lattice needs two rays for each
// wavelength; 2.5 are required of the spiral.
double AliasedSlopeVariance(const SurfaceModel& model, const BeamOptions& beam, int rays) {
  const double spacing = beam.footprint * std::sqrt(std::numbers::pi / 4 / rays);
  const double sampled = 2 * std::numbers::pi / (2.5 * spacing);
  return model.FacetSlopeCovariance([&](double k, double) { return k > sampled ? 1.0 : 0.0; }).trace() / rays;
}

double SeenSlopeVariance(const SeaState& sea, const BeamOptions& beam) {
  return SlopeCovariance(sea, [&](double k, double psi) { return FootprintPower(beam, k, psi); }).trace();
}

}  // namespace

const BeamOptions& WidestBeam(const std::vector<BeamOptions>& beams) {
  assert(!beams.empty());
  return *std::max_element(beams.begin(), beams.end(),
                           [](const auto& a, const auto& b) { return a.incidence < b.incidence; });
}

double FootprintSlopeFraction(const SeaState& sea, const SurfaceModel& model,
                              const std::vector<BeamOptions>& beams) {
  double least = std::numeric_limits<double>::infinity();
  for (const BeamOptions& beam : beams) {
    const auto seen = [&](double k, double psi) { return FootprintPower(beam, k, psi); };
    least = std::min(least, model.FacetSlopeCovariance(seen).trace() / SeenSlopeVariance(sea, beam));
  }
  return least;
}

Discretization ChooseDiscretization(const SeaState& sea, const std::vector<BeamOptions>& beams) {
  const BeamOptions& widest = WidestBeam(beams);
  const double seen = SeenSlopeVariance(sea, widest);
  const double least = std::max(seen, kLeastSeenFraction * SlopeCovariance(sea).trace());
  Discretization choice{kNarrowestPatch, kCoarsestPoints, kFewestRays};
  while (choice.points_per_footprint < kFinestPoints &&
         GridLoss(sea, widest, widest.footprint / choice.points_per_footprint, seen) * seen >
             kGridLoss * least) {
    choice.points_per_footprint *= 1.25;
  }
  while (choice.patch_per_beam < kWidestPatch &&
         std::abs(FootprintSlopeFraction(sea, SurfaceModel(sea, widest, choice), {widest}) - 1) * seen >
             kPatchDeparture * least) {
    choice.patch_per_beam *= 1.25;
  }
  const SurfaceModel model(sea, widest, choice);
  while (choice.rays < kMostRays &&
         AliasedSlopeVariance(model, widest, choice.rays) > kAliasedFraction * least) {
    choice.rays = std::min(choice.rays * 5 / 4, kMostRays);
  }
  return choice;
}

}  // namespace albtpu
