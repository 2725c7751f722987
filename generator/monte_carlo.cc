#include "generator/monte_carlo.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

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
};

// The Monte Carlo's record of one beam: its errors in one realization, linear in depth d, reported minus
// true.
struct BeamErrors {
  Eigen::Vector2d tangent;               // t - t_still
  Eigen::Vector2d horizontal_offset;     // m, and
  Eigen::Vector2d horizontal_per_depth;  // the spot's horizontal error is offset + d per_depth
  double vertical_offset;                // m, the same of elevation
  double vertical_per_depth;
};

// Still water would put the spot t_still d from the meeting and make the path d sec_still long; the true
// centroid is the traced one, and the depth that is reported is the mean path over sec_still.
BeamErrors ErrorsOf(const TracedBeam& traced, const TracedBeam& still) {
  const Eigen::Vector2d tangent = traced.tangent - still.tangent;
  return {tangent, -traced.height_tangent, -tangent, -traced.height_secant / still.secant,
          1 - traced.secant / still.secant};
}

TracedBeam StillWater(const std::vector<Ray>& rays, double refractive_index) {
  return Trace(rays, HeightField(std::vector<double>(9, 0.0), 3, 1.0), refractive_index);
}

bool AtNadir(const PreparedBeam& prepared) { return prepared.beam.options().incidence == 0; }

std::vector<PreparedBeam> Prepare(const Encounter& encounter, int ray_count,
                                  const Eigen::Matrix2d& unresolved_slopes) {
  std::vector<PreparedBeam> beams;
  for (const BeamOptions& options : encounter.beams) {
    Beam beam(options, ray_count);
    std::vector<Ray> rays = beam.Rays(0);
    const TracedBeam still = StillWater(rays, encounter.refractive_index);
    beams.push_back({std::move(beam),
                     EffectOfUnresolvedWaves(options, encounter.refractive_index, unresolved_slopes), still,
                     std::move(rays)});
  }
  return beams;
}

// The errors of all beams on one surface.
std::vector<BeamErrors> Realize(const std::vector<PreparedBeam>& beams, const SeaSurface& surface,
                                double refractive_index) {
  std::vector<BeamErrors> errors;
  for (std::size_t b = 0; b < beams.size(); ++b) {
    if (b > 0 && AtNadir(beams[b]) && AtNadir(beams[b - 1])) {  // without an azimuth: one beam for all
      errors.push_back(errors.back());
      continue;
    }
    const PreparedBeam& prepared = beams[b];
    const SeaSurface::Window window = surface.WindowUnder(prepared.beam);
    const bool collimated = std::isinf(prepared.beam.options().source_height);
    const TracedBeam traced = Trace(collimated ? prepared.rays : prepared.beam.Rays(window.elevation),
                                    window.heights, refractive_index);
    errors.push_back(ErrorsOf(WithUnresolvedWaves(traced, prepared.unresolved), prepared.still_water));
  }
  return errors;
}

// One beam's realizations as columns.
struct Sample {
  Eigen::ArrayXd tangent_x, tangent_y;
  Eigen::ArrayXd x_offset, x_per_depth, y_offset, y_per_depth, z_offset, z_per_depth;

  Sample(const std::vector<std::vector<BeamErrors>>& realizations, std::size_t beam) {
    const auto column = [&](auto&& value) {
      Eigen::ArrayXd values(static_cast<Eigen::Index>(realizations.size()));
      for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = value(realizations[i][beam]);
      return values;
    };
    tangent_x = column([](const BeamErrors& e) { return e.tangent.x(); });
    tangent_y = column([](const BeamErrors& e) { return e.tangent.y(); });
    x_offset = column([](const BeamErrors& e) { return e.horizontal_offset.x(); });
    x_per_depth = column([](const BeamErrors& e) { return e.horizontal_per_depth.x(); });
    y_offset = column([](const BeamErrors& e) { return e.horizontal_offset.y(); });
    y_per_depth = column([](const BeamErrors& e) { return e.horizontal_per_depth.y(); });
    z_offset = column([](const BeamErrors& e) { return e.vertical_offset; });
    z_per_depth = column([](const BeamErrors& e) { return e.vertical_per_depth; });
  }
};

BeamUncertainty Uncertainty(const Sample& sample, const Eigen::Vector2d& azimuth,
                            const std::vector<double>& depths) {
  BeamUncertainty result;
  result.refraction_along_wind = TwoSigma(sample.tangent_x.atan());
  result.refraction_cross_wind = TwoSigma(sample.tangent_y.atan());
  for (const double depth : depths) {
    const Eigen::ArrayXd x = sample.x_offset + depth * sample.x_per_depth;
    const Eigen::ArrayXd y = sample.y_offset + depth * sample.y_per_depth;
    const Eigen::ArrayXd z = sample.z_offset + depth * sample.z_per_depth;
    result.thu.push_back(TwoSigma(x, y));
    result.tvu.push_back(TwoSigma(z));
    result.bias_along_beam.push_back(Mean(azimuth.x() * x + azimuth.y() * y));
    result.bias_vertical.push_back(Mean(z));
  }
  return result;
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

  const std::vector<PreparedBeam> beams = Prepare(encounter, discretization.rays, all_slopes - facet_slopes);
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
      const Sample sample(realizations, b);
      result.beams.push_back(Uncertainty(sample, beams[b].beam.azimuth_direction(), encounter.depths));
      result.converged = result.converged &&
                         (effort.relative_error == 0 || Meets(result.beams.back(), effort.relative_error));
    }
  } while (!result.converged && static_cast<int>(realizations.size()) < effort.most_realizations);
  result.realizations = static_cast<int>(realizations.size());
  return result;
}

}  // namespace albtpu
