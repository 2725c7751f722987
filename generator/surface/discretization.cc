#include "generator/surface/discretization.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace albtpu {
namespace {

// A deviation is the root of a variance: half a per cent of variance is a quarter of a per cent of what is
// reported. Where the search begins is enough for footprints narrower than the waves; where it ends bounds the
// cost of those that see next to nothing. convergence_validation_test holds the result.
constexpr double kGridLoss = 0.004;
constexpr double kPatchDeparture = 0.005;
// The estimate of what aliases is half of what doubling the rays was seen to take away.
constexpr double kAliasedFraction = 0.0075;
constexpr double kNarrowestPatch = 2.5, kWidestPatch = 8;    // widths of the beam
constexpr double kCoarsestPoints = 64, kFinestPoints = 256;  // along the footprint
// Fewer rays sample the squares of slopes too coarsely, on which vertical errors at nadir rest: 1000 were seen to
// add 3 % to them, 4000 add 0.1 %.
constexpr int kFewestRays = 4000;

// The part of the slope variance seen by the footprint that facets of the side `spacing` take away: waves
// under two facets long, and of the others what a difference quotient misses of the slope.
double GridLoss(const SeaState& sea, const BeamOptions& beam, double spacing, double seen) {
  const Eigen::Matrix2d facets = SlopeCovariance(sea, [&](double k, double psi) {
    const double x = k * std::cos(psi) * spacing / 2, y = k * std::sin(psi) * spacing / 2;
    if (std::max(std::abs(x), std::abs(y)) > std::numbers::pi / 2) return 0.0;
    const double quotient = (std::pow(std::sin(x), 2) + std::pow(std::sin(y), 2)) / (x * x + y * y);
    return FootprintPower(beam, k, psi) * quotient;
  });
  return 1 - facets.trace() / seen;
}

// The variance of a beam's mean slope that comes from waves which its rays are too far apart to sample: their
// slope variance over the number of rays. Two rays a wave is the limit of a square lattice; 2.5 are asked of
// a spiral.
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
