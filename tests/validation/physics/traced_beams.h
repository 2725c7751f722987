// Beams that were traced through realizations of a sea by the Monte Carlo, with exact refraction: the errors of each
// realization, and their statistics as a table has them.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "generator/monte_carlo/beam_tracing.h"
#include "generator/monte_carlo/slope_moments.h"
#include "generator/surface/discretization.h"
#include "sea/response/closed_form.h"
#include "sea/sea_state.h"

namespace albtpu::testing {

// What waves do to one kind of beam.
struct TracedErrors {
  std::vector<BeamErrors> draws;  // Less their means, which are biases.
  BeamErrors mean;
  BeamUncertainty uncertainty;
};

struct Tracing {
  std::vector<BeamOptions> beams;
  double refractive_index;
  std::vector<double> depths;
  int realizations, rays;
};

// By beam.
inline std::vector<TracedErrors> TraceBeams(const SeaState& sea, const Tracing& asked) {
  const std::vector<BeamOptions>& beams = asked.beams;
  const Discretization grid = ChooseDiscretization(sea, beams);
  const SurfaceModel model(sea, beams.back(), grid);
  const auto tracing =
      MakePlainTracing(model, {.beams = beams,
                               .refractive_index = asked.refractive_index,
                               .rays = asked.rays,
                               .unresolved_slopes = Eigen::Matrix2d::Zero(),
                               .resolved_slopes = model.FacetSlopeCovariance([](double, double) { return 1.0; })});
  std::vector<std::vector<BeamRealization>> samples(beams.size());
  std::vector<BeamRealization> realized(beams.size());
  const std::vector<bool> all(beams.size(), true);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(asked.realizations); ++i) {
    tracing->Realize(NormalStream(7, 0, i), all, realized);
    for (std::size_t b = 0; b < beams.size(); ++b) samples[b].push_back(realized[b]);
  }
  std::vector<TracedErrors> traced(beams.size());
  for (std::size_t b = 0; b < beams.size(); ++b) {
    traced[b].uncertainty = UncertaintyOf(samples[b], beams[b], asked.refractive_index, std::nullopt, asked.depths);
    BeamErrors& mean = traced[b].mean;
    const double share = 1.0 / asked.realizations;
    for (const BeamRealization& each : samples[b]) {
      const BeamErrors& e = each.parts[0].errors;
      traced[b].draws.push_back(e);
      mean.horizontal_offset += share * e.horizontal_offset;
      mean.horizontal_per_depth += share * e.horizontal_per_depth;
      mean.vertical_offset += share * e.vertical_offset;
      mean.vertical_per_depth += share * e.vertical_per_depth;
    }
    for (BeamErrors& e : traced[b].draws) {
      e.horizontal_offset -= mean.horizontal_offset;
      e.horizontal_per_depth -= mean.horizontal_per_depth;
      e.vertical_offset -= mean.vertical_offset;
      e.vertical_per_depth -= mean.vertical_per_depth;
    }
  }
  return traced;
}

// The error of what processing reports: it puts the point at the end of the measured path in water along the ray of
// still water; the light met the bottom at the traced spot. x and y on the axes of the sea, z up.
inline Eigen::Vector3d ErrorOfReportedPoint(const BeamErrors& e, double depth, const BeamOptions& beam, double index) {
  const double refracted = StillWaterRefraction(beam.incidence, index);
  const Eigen::Vector2d along(std::cos(beam.azimuth), std::sin(beam.azimuth));
  // From where the ray entered the water: still water's spot less the horizontal error, and the measured path.
  const Eigen::Vector2d spot =
      depth * std::tan(refracted) * along - (e.horizontal_offset + depth * e.horizontal_per_depth);
  const double path = (depth - (e.vertical_offset + depth * e.vertical_per_depth)) / std::cos(refracted);
  Eigen::Vector3d error;
  error.head<2>() = path * std::sin(refracted) * along - spot;
  error.z() = depth - path * std::cos(refracted);
  return error;
}

}  // namespace albtpu::testing
