#include "generator/surface/discretization.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace albtpu {
namespace {

// Limits on variances. A reported deviation is the square root of a variance: 0.1 % of variance is 0.05 % of the
// result. convergence_validation_test checks the result.
constexpr double kGridLoss = 0.0005;
constexpr double kPatchDeparture = 0.0015;
// AliasedSlopeVariance finds about half of the variance that doubling the rays was observed to remove.
constexpr double kAliasedFraction = 0.0075;
// The search starts at values that suffice for footprints narrower than the waves. Its ends limit the cost for
// footprints over which the waves nearly average out.
constexpr double kNarrowestPatch = 2.5, kWidestPatch = 8;    // widths of the beam
constexpr double kCoarsestPoints = 64, kFinestPoints = 256;  // along the footprint
// Vertical errors at nadir depend on the squares of the slopes, which few rays sample too coarsely: 1000 rays were
// observed to add 3 % to these errors, 4000 rays add 0.1 %.
constexpr int kFewestRays = 4000;

// The slope variance over the footprint, `seen` in all, that is lost on facets with the side `spacing` [m]: that of the
// waves shorter than two facets along either axis.
double GridLoss(const SeaState& sea, const BeamOptions& beam, double spacing, double seen) {
  const Eigen::Matrix2d facets = SlopeCovariance(sea, [&](double k, double psi) {
    const double along_axis = k * std::max(std::abs(std::cos(psi)), std::abs(std::sin(psi)));
    return along_axis * spacing > std::numbers::pi ? 0.0 : FootprintPower(beam, k, psi);
  });
  return seen - facets.trace();
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

// Whether the slope variances over the footprint of each beam, along and across the wind, agree with the closed form
// within kPatchDeparture of half of `least`, the mean square slope that matters.
bool HasTheSlopesSeen(const SeaState& sea, const SurfaceModel& model, const std::vector<BeamOptions>& beams,
                      double least) {
  return std::all_of(beams.begin(), beams.end(), [&](const BeamOptions& beam) {
    const auto seen = [&](double k, double psi) { return FootprintPower(beam, k, psi); };
    const Eigen::Matrix2d error = model.FacetSlopeCovariance(seen) - SlopeCovariance(sea, seen);
    return error.diagonal().cwiseAbs().maxCoeff() <= kPatchDeparture * least / 2;
  });
}

}  // namespace

const BeamOptions& WidestBeam(const std::vector<BeamOptions>& beams) {
  assert(!beams.empty());
  return *std::max_element(beams.begin(), beams.end(),
                           [](const auto& a, const auto& b) { return a.incidence < b.incidence; });
}

std::vector<BeamOptions> OutermostBeams(const std::vector<BeamOptions>& beams) {
  assert(!beams.empty());
  const auto narrower = [](const BeamOptions& a, const BeamOptions& b) {
    return std::pair(a.incidence, a.azimuth) < std::pair(b.incidence, b.azimuth);
  };
  const auto wider = [](const BeamOptions& a, const BeamOptions& b) {
    return std::pair(-a.incidence, a.azimuth) < std::pair(-b.incidence, b.azimuth);
  };
  std::vector<BeamOptions> outermost;
  for (const auto& beam :
       {std::min_element(beams.begin(), beams.end(), narrower), std::min_element(beams.begin(), beams.end(), wider),
        std::max_element(beams.begin(), beams.end(), narrower)})
    if (std::none_of(outermost.begin(), outermost.end(), [&](const BeamOptions& other) {
          return other.incidence == beam->incidence && other.azimuth == beam->azimuth;
        }))
      outermost.push_back(*beam);
  return outermost;
}

double FootprintSlopeFraction(const SeaState& sea, const SurfaceModel& model, const std::vector<BeamOptions>& beams) {
  double least = std::numeric_limits<double>::infinity();
  for (const BeamOptions& beam : beams) {
    const auto seen = [&](double k, double psi) { return FootprintPower(beam, k, psi); };
    least = std::min(least, model.FacetSlopeCovariance(seen).trace() / SeenSlopeVariance(sea, beam));
  }
  return least;
}

Discretization ChooseDiscretization(const SeaState& sea, const std::vector<BeamOptions>& beams) {
  const BeamOptions& widest = WidestBeam(beams);
  const std::vector<BeamOptions> outermost = OutermostBeams(beams);
  const double seen = SeenSlopeVariance(sea, widest);
  const double least = std::max(seen, kMinSeenFraction * SlopeCovariance(sea).trace());
  Discretization choice{kNarrowestPatch, kCoarsestPoints, kFewestRays};
  while (choice.points_per_footprint < kFinestPoints &&
         GridLoss(sea, widest, widest.footprint / choice.points_per_footprint, seen) > kGridLoss * least)
    choice.points_per_footprint *= 1.25;
  std::optional<SurfaceModel> model(std::in_place, sea, widest, choice);
  while (choice.patch_per_beam < kWidestPatch && !HasTheSlopesSeen(sea, *model, outermost, least)) {
    choice.patch_per_beam *= 1.25;
    model.emplace(sea, widest, choice);
  }
  while (choice.rays < kMaxRays && AliasedSlopeVariance(*model, widest, choice.rays) > kAliasedFraction * least)
    choice.rays = std::min(choice.rays * 5 / 4, kMaxRays);
  return choice;
}

}  // namespace albtpu
