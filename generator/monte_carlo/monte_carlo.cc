#include "generator/monte_carlo/monte_carlo.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "absl/strings/str_format.h"
#include "generator/math/random_stream.h"
#include "generator/monte_carlo/beam_tracing.h"
#include "generator/surface/sea_surface.h"
#include "sea/angle.h"
#include "sea/principal_axes.h"

namespace albtpu {
namespace {

// The relative error of values below 0.01 degrees and 1 mm does not matter. These are a tenth less, because balancing
// (generator/campaign/table_maker.h) raises some values by a few per cent.
const double kNegligibleAngle = RadiansOfDegrees(0.009);
constexpr double kNegligibleLength = 0.9e-3;  // m

bool HasConverged(const BeamUncertainty& beam, double relative_error) {
  const auto has_converged = [&](const Estimate& estimate, double negligible) {
    return estimate.value < negligible || estimate.standard_error <= relative_error * estimate.value;
  };
  const auto length_has_converged = [&](const Estimate& estimate) {
    return has_converged(estimate, kNegligibleLength);
  };
  return has_converged(beam.refraction_along_wind, kNegligibleAngle) &&
         has_converged(beam.refraction_cross_wind, kNegligibleAngle) &&
         std::all_of(beam.thu.begin(), beam.thu.end(), length_has_converged) &&
         std::all_of(beam.tvu.begin(), beam.tvu.end(), length_has_converged);
}

// The number of realizations to reach when `done` were not enough: half as many again, in whole batches.
int NextCount(int done, const Effort& effort) {
  const int batches = std::max(1, done / 2 / kBatch);
  return std::min(done + batches * kBatch, effort.most_realizations);
}

// The slope covariance of the waves that the facets do not have, `all` less `facets`, with the same trace and no
// negative variance in any direction. The two sides of a triangle are not at the same point: their slopes correlate
// where those of the waves do not, and along one diagonal facets may have more slope than the waves.
Eigen::Matrix2d UnresolvedSlopes(const Eigen::Matrix2d& all, const Eigen::Matrix2d& facets) {
  const PrincipalAxes axes = PrincipalAxesOf(all - facets);
  const double trace = std::max(0.0, axes.variances.sum());
  const double least = std::clamp(axes.variances[0], 0.0, trace);
  const Eigen::Vector2d variances(least, trace - least);
  return axes.directions * variances.asDiagonal() * axes.directions.transpose();
}

// The exact result without waves: nothing to draw, and no errors.
SeaCaseResult InStillWater(const SeaCase& sea_case) {
  const std::vector<Estimate> zeros(sea_case.depths.size());
  const BeamUncertainty none{{}, {}, zeros, zeros, zeros, zeros, 0};
  SeaCaseResult result;
  result.beams.assign(sea_case.beams.size(), none);
  result.footprint_slope_fraction = 1;
  result.resolved_slope_fraction = 1;
  return result;
}

}  // namespace

std::string_view Name(Estimator estimator) { return estimator == Estimator::kPlain ? "plain" : "control_variate"; }

std::optional<Estimator> FindEstimator(std::string_view name) {
  for (const Estimator estimator : {Estimator::kControlVariate, Estimator::kPlain})
    if (name == Name(estimator)) return estimator;
  return std::nullopt;
}

absl::Status CheckTraceable(const SeaCase& sea_case) {
  const SeaState sea(sea_case.sea);
  const Eigen::Matrix2d slopes = SlopeCovariance(sea);
  const double elevation = std::sqrt(ElevationVariance(sea));
  for (const BeamOptions& beam : sea_case.beams) {
    const Eigen::Vector2d azimuth(std::cos(beam.azimuth), std::sin(beam.azimuth));
    const double slope = std::sqrt(azimuth.dot(slopes * azimuth));
    if (!(kFacingDeviations * slope * std::tan(beam.incidence) <= 1)) {
      return absl::InvalidArgumentError(absl::StrFormat(
          "waves hide behind each other at an incidence of %g degrees (the slope along the beam has a standard "
          "deviation of %.3f, and %g of them must face the beam); give at most %.1f degrees, or a weaker wind",
          DegreesOfRadians(beam.incidence), slope, kFacingDeviations,
          std::floor(10 * DegreesOfRadians(std::atan(1 / (kFacingDeviations * slope)))) / 10));
    }
    if (!(beam.source_height >= kCrestDeviations * elevation)) {
      return absl::InvalidArgumentError(absl::StrFormat(
          "a point source at a height of %g m stands below crests (the elevation of the surface has a standard "
          "deviation of %.3g m); give at least %.3g m, %g of them, or inf, a collimated beam",
          beam.source_height, elevation, kCrestDeviations * elevation, kCrestDeviations));
    }
  }
  return absl::OkStatus();
}

SeaCaseResult Simulate(const SeaCase& sea_case, const Effort& effort, std::uint64_t seed, std::uint32_t cell) {
  assert(!sea_case.beams.empty() && effort.realizations >= 2);
  const SeaState sea(sea_case.sea);
  const Eigen::Matrix2d all_slopes = SlopeCovariance(sea);
  if (all_slopes.trace() == 0) return InStillWater(sea_case);
  Discretization discretization =
      sea_case.discretization ? *sea_case.discretization : ChooseDiscretization(sea, sea_case.beams);
  if (sea_case.rays) discretization.rays = *sea_case.rays;
  const SurfaceModel model(sea, WidestBeam(sea_case.beams), discretization);

  SeaCaseResult result;
  result.rays = discretization.rays;
  result.patch_length = model.patch().length();
  result.spacing = model.patch().spacing();
  const Eigen::Matrix2d facet_slopes = model.FacetSlopeCovariance([](double, double) { return 1.0; });
  result.resolved_slope_fraction = facet_slopes.trace() / all_slopes.trace();
  result.footprint_slope_fraction = FootprintSlopeFraction(sea, model, OutermostBeams(sea_case.beams));

  const TracedBeams traced{sea_case.beams, sea_case.refractive_index, discretization.rays,
                           UnresolvedSlopes(all_slopes, facet_slopes), facet_slopes};
  const bool collimated = std::isinf(sea_case.beams.front().source_height);
  const std::unique_ptr<BeamTracing> tracing = effort.estimator == Estimator::kControlVariate && collimated
                                                   ? MakeAntitheticTracing(model, traced)
                                                   : MakePlainTracing(model, traced);

  const std::size_t count = sea_case.beams.size();
  result.beams.resize(count);
  std::vector<bool> wanted(count, true);  // beams that need more realizations
  std::vector<std::vector<BeamRealization>> realizations;
  for (int goal = effort.realizations; true; goal = NextCount(result.realizations, effort)) {
    const int first = result.realizations;
    result.realizations = goal;
    realizations.resize(goal, std::vector<BeamRealization>(count));
    tbb::parallel_for(first, goal,
                      [&](int i) { tracing->Realize(NormalStream(seed, cell, i), wanted, realizations[i]); });
    result.converged = true;
    for (std::size_t b = 0; b < count; ++b) {
      if (!wanted[b]) continue;
      std::vector<BeamRealization> sample;
      for (const std::vector<BeamRealization>& realization : realizations) sample.push_back(realization[b]);
      result.beams[b] = UncertaintyOf(sample, sea_case.beams[b], sea_case.refractive_index, tracing->known_slopes(b),
                                      sea_case.depths);
      wanted[b] = effort.relative_error > 0 && !HasConverged(result.beams[b], effort.relative_error);
      result.converged = result.converged && !wanted[b];
    }
    if (result.converged || goal >= effort.most_realizations) return result;
  }
}

}  // namespace albtpu
