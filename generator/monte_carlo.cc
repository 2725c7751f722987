#include "generator/monte_carlo.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "generator/beam_errors.h"
#include "generator/mean_slope.h"
#include "generator/mean_square_slope.h"
#include "generator/random_stream.h"
#include "generator/ray_tracer.h"
#include "generator/sea_surface.h"

namespace albtpu {
namespace {

// A beam with what does not change from realization to realization.
struct PreparedBeam {
  Beam beam;
  UnresolvedWaves unresolved;
  TracedBeam still_water;
  std::vector<Ray> rays;  // of a collimated beam: those of a point source depend on the elevation
  std::optional<MeanSlope> mean_slope;  // absent: tracing alone, as always for a point source
  std::optional<KnownSlopes> known_slopes;
};

TracedBeam StillWater(const std::vector<Ray>& rays, double refractive_index) {
  return Trace(rays, HeightField(std::vector<double>(9, 0.0), 3, 1.0), refractive_index);
}

bool AtNadir(const PreparedBeam& prepared) { return prepared.beam.options().incidence == 0; }

bool Collimated(const Beam& beam) { return std::isinf(beam.options().source_height); }

// At nadir there is no azimuth: one beam stands for those of all azimuths.
bool OneBeam(const PreparedBeam& a, const PreparedBeam& b) { return AtNadir(a) && AtNadir(b); }

void KnowSlopes(const SurfaceModel& model, PreparedBeam& prepared) {
  prepared.mean_slope.emplace(model, prepared.beam, prepared.rays);
  prepared.known_slopes = {prepared.mean_slope->mean(), prepared.mean_slope->covariance(), {}};
  if (AtNadir(prepared))
    prepared.known_slopes->of_the_square = MomentsOfMeanSquareSlope(model, prepared.rays);
}

std::vector<PreparedBeam> Prepare(const Encounter& encounter, const SurfaceModel& model, Estimator estimator,
                                  int ray_count, const Eigen::Matrix2d& unresolved_slopes) {
  std::vector<PreparedBeam> beams;
  for (const BeamOptions& options : encounter.beams) {
    Beam beam(options, ray_count);
    std::vector<Ray> rays = beam.Rays(0);
    const TracedBeam still = StillWater(rays, encounter.refractive_index);
    PreparedBeam prepared{std::move(beam),
                          EffectOfUnresolvedWaves(options, encounter.refractive_index, unresolved_slopes),
                          still,
                          std::move(rays),
                          {},
                          {}};
    if (!beams.empty() && OneBeam(beams.back(), prepared)) {
      prepared.known_slopes = beams.back().known_slopes;
    } else if (estimator == Estimator::kControlVariate && Collimated(prepared.beam)) {
      KnowSlopes(model, prepared);
    }
    beams.push_back(std::move(prepared));
  }
  return beams;
}

// The errors of all beams on one surface.
std::vector<BeamErrors> Realize(const std::vector<PreparedBeam>& beams, const SeaSurface& surface,
                                double refractive_index) {
  std::vector<BeamErrors> errors;
  for (std::size_t b = 0; b < beams.size(); ++b) {
    if (b > 0 && OneBeam(beams[b - 1], beams[b])) {
      errors.push_back(errors.back());
      continue;
    }
    const PreparedBeam& prepared = beams[b];
    const SeaSurface::Window window = surface.WindowUnder(prepared.beam);
    const TracedBeam traced =
        Trace(Collimated(prepared.beam) ? prepared.rays : prepared.beam.Rays(window.elevation),
              window.heights, refractive_index);
    errors.push_back(ErrorsOf(WithUnresolvedWaves(traced, prepared.unresolved), prepared.still_water));
    if (prepared.mean_slope) errors.back().mean_slope = (*prepared.mean_slope)(window.heights);
    errors.back().mean_square_slope = traced.slope_squares.x() + traced.slope_squares.y();
  }
  return errors;
}

bool Meets(const Estimate& estimate, double relative_error) {
  return estimate.standard_error <= relative_error * estimate.value;
}

bool Meets(const BeamUncertainty& beam, double relative_error) {
  const auto meets = [&](const Estimate& e) { return Meets(e, relative_error); };
  return meets(beam.refraction_along_wind) && meets(beam.refraction_cross_wind) &&
         std::all_of(beam.thu.begin(), beam.thu.end(), meets) &&
         std::all_of(beam.tvu.begin(), beam.tvu.end(), meets);
}

}  // namespace

std::string_view Name(Estimator estimator) {
  return estimator == Estimator::kPlain ? "plain" : "control_variate";
}

std::optional<Estimator> FindEstimator(std::string_view name) {
  for (const Estimator estimator : {Estimator::kControlVariate, Estimator::kPlain}) {
    if (name == Name(estimator)) return estimator;
  }
  return std::nullopt;
}

EncounterResult Simulate(const Encounter& encounter, const Effort& effort, std::uint64_t seed,
                         std::uint32_t cell) {
  assert(!encounter.beams.empty() && effort.realizations >= 2);
  const SeaState sea(encounter.sea);
  Discretization discretization =
      encounter.discretization ? *encounter.discretization : ChooseDiscretization(sea, encounter.beams);
  if (encounter.rays) discretization.rays = *encounter.rays;
  const SurfaceModel model(sea, WidestBeam(encounter.beams), discretization);

  EncounterResult result;
  result.rays = discretization.rays;
  result.patch_length = model.patch().length();
  result.spacing = model.patch().spacing();
  const Eigen::Matrix2d all_slopes = SlopeCovariance(sea);
  const Eigen::Matrix2d facet_slopes = model.FacetSlopeCovariance([](double, double) { return 1.0; });
  result.resolved_slope_fraction = facet_slopes.trace() / all_slopes.trace();
  result.footprint_slope_fraction = FootprintSlopeFraction(sea, model, encounter.beams);

  const std::vector<PreparedBeam> beams =
      Prepare(encounter, model, effort.estimator, discretization.rays, all_slopes - facet_slopes);
  std::vector<std::vector<BeamErrors>> realizations;
  do {
    const int first = static_cast<int>(realizations.size());
    const int wanted = first < effort.realizations ? effort.realizations : first + kBatch;
    realizations.resize(std::min(wanted, effort.most_realizations));
    tbb::parallel_for(first, static_cast<int>(realizations.size()), [&](int i) {
      const SeaSurface surface(model, NormalStream(seed, cell, i));
      realizations[i] = Realize(beams, surface, encounter.refractive_index);
    });

    result.beams.clear();
    result.converged = true;
    for (std::size_t b = 0; b < beams.size(); ++b) {
      std::vector<BeamErrors> sample;
      for (const std::vector<BeamErrors>& realization : realizations) sample.push_back(realization[b]);
      result.beams.push_back(UncertaintyOf(sample, beams[b].beam.options(), encounter.refractive_index,
                                           beams[b].known_slopes, encounter.depths));
      result.converged = result.converged &&
                         (effort.relative_error == 0 || Meets(result.beams.back(), effort.relative_error));
    }
  } while (!result.converged && static_cast<int>(realizations.size()) < effort.most_realizations);
  result.realizations = static_cast<int>(realizations.size());
  return result;
}

}  // namespace albtpu
