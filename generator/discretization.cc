#include "generator/discretization.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "generator/sea_surface.h"

namespace albtpu {
namespace {

constexpr double kPatchPerBeam = 4;
constexpr double kCoarsestPoints = 32, kFinestPoints = 512;
constexpr int kFewestRays = 1000, kMostRays = 64000;
constexpr double kSlopeFraction = 0.995;
constexpr double kAliasedFraction = 0.015;

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
  Discretization choice{kPatchPerBeam, kCoarsestPoints, kFewestRays};
  while (choice.points_per_footprint < kFinestPoints &&
         FootprintSlopeFraction(sea, SurfaceModel(sea, widest, choice), {widest}) < kSlopeFraction) {
    choice.points_per_footprint *= 1.5;
  }
  const SurfaceModel model(sea, widest, choice);
  const double allowed = kAliasedFraction * SeenSlopeVariance(sea, widest);
  while (choice.rays < kMostRays && AliasedSlopeVariance(model, widest, choice.rays) > allowed) {
    choice.rays = choice.rays * 3 / 2;
  }
  return choice;
}

}  // namespace albtpu
