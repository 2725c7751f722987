#include "generator/monte_carlo.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "generator/mean_slope.h"
#include "generator/random_stream.h"
#include "generator/ray_tracer.h"
#include "generator/refraction.h"
#include "generator/sea_surface.h"

namespace albtpu {
namespace {

// A beam with what does not change from realization to realization.
struct PreparedBeam {
  Beam beam;
  UnresolvedWaves unresolved;
  TracedBeam still_water;
  std::vector<Ray> rays;  // of a collimated beam: those of a point source depend on the elevation
  std::optional<MeanSlope> mean_slope;  // absent: plain Monte Carlo, and always for a point source
  Eigen::Matrix2d answer;               // of the tangent to the mean slope, to first order
};

// The Monte Carlo's record of one beam: its errors in one realization, linear in depth d, reported minus
// true.
struct BeamErrors {
  Eigen::Vector2d tangent;               // t - t_still
  Eigen::Vector2d horizontal_offset;     // m, and
  Eigen::Vector2d horizontal_per_depth;  // the spot's horizontal error is offset + d per_depth
  double vertical_offset;                // m, the same of elevation
  double vertical_per_depth;
  Eigen::Vector2d mean_slope = Eigen::Vector2d::Zero();  // of MeanSlope
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

// The mean tangent answers to the mean slope by the gains of Snell's law.
Eigen::Matrix2d SmallSlopeAnswer(const Beam& beam, double refractive_index) {
  const SlopeGain gain = SmallSlopeGain(beam.options().incidence, refractive_index);
  const Eigen::Vector2d azimuth = beam.azimuth_direction();
  return gain.out_of_plane * Eigen::Matrix2d::Identity() +
         (gain.in_plane - gain.out_of_plane) * azimuth * azimuth.transpose();
}

bool Collimated(const Beam& beam) { return std::isinf(beam.options().source_height); }

std::vector<PreparedBeam> Prepare(const Encounter& encounter, const SurfaceModel& model, Estimator estimator,
                                  int ray_count, const Eigen::Matrix2d& unresolved_slopes) {
  std::vector<PreparedBeam> beams;
  for (const BeamOptions& options : encounter.beams) {
    Beam beam(options, ray_count);
    std::vector<Ray> rays = beam.Rays(0);
    std::optional<MeanSlope> mean_slope;
    if (estimator == Estimator::kControlVariate && Collimated(beam)) mean_slope.emplace(model, beam, rays);
    const TracedBeam still = StillWater(rays, encounter.refractive_index);
    const Eigen::Matrix2d answer = SmallSlopeAnswer(beam, encounter.refractive_index);
    beams.push_back({std::move(beam),
                     EffectOfUnresolvedWaves(options, encounter.refractive_index, unresolved_slopes), still,
                     std::move(rays), std::move(mean_slope), answer});
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
    const TracedBeam traced =
        Trace(Collimated(prepared.beam) ? prepared.rays : prepared.beam.Rays(window.elevation),
              window.heights, refractive_index);
    errors.push_back(ErrorsOf(WithUnresolvedWaves(traced, prepared.unresolved), prepared.still_water));
    if (prepared.mean_slope) errors.back().mean_slope = (*prepared.mean_slope)(window.heights);
  }
  return errors;
}

// One beam's realizations as columns.
struct Sample {
  Eigen::ArrayXd tangent_x, tangent_y;
  Eigen::ArrayXd x_offset, x_per_depth, y_offset, y_per_depth, z_offset, z_per_depth;
  Eigen::ArrayXd slope_x, slope_y;

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
    slope_x = column([](const BeamErrors& e) { return e.mean_slope.x(); });
    slope_y = column([](const BeamErrors& e) { return e.mean_slope.y(); });
  }
};

// What the mean slope says of the errors of a beam, in each realization and in expectation, to first order.
class Prediction {
 public:
  Prediction(const PreparedBeam& prepared, const Sample& sample, double refractive_index)
      : answer_(prepared.answer),
        mean_(prepared.answer * prepared.mean_slope->mean()),
        covariance_(answer_ * prepared.mean_slope->covariance() * answer_.transpose()),
        tangent_x_(answer_(0, 0) * sample.slope_x + answer_(0, 1) * sample.slope_y),
        tangent_y_(answer_(1, 0) * sample.slope_x + answer_(1, 1) * sample.slope_y) {
    // The path per depth is 1 / cos(theta_r), of which sin(theta_r) is the derivative by the in-plane tangent.
    const double refracted = StillWaterRefraction(prepared.beam.options().incidence, refractive_index);
    vertical_ = -std::sin(refracted) * std::cos(refracted) * prepared.beam.azimuth_direction();
  }

  Control TangentX() const { return {tangent_x_, {}, mean_.x(), covariance_(0, 0)}; }
  Control TangentY() const { return {tangent_y_, {}, mean_.y(), covariance_(1, 1)}; }
  Control Horizontal(double depth) const {
    return {-depth * tangent_x_, -depth * tangent_y_, 0, depth * depth * covariance_.trace()};
  }
  Control Along(const Eigen::Vector2d& azimuth, double depth) const { return Combined(-depth * azimuth); }
  Control Vertical(double depth) const { return Combined(depth * vertical_); }

 private:
  Control Combined(const Eigen::Vector2d& of_tangent) const {
    return {of_tangent.x() * tangent_x_ + of_tangent.y() * tangent_y_,
            {},
            of_tangent.dot(mean_),
            of_tangent.dot(covariance_ * of_tangent)};
  }

  Eigen::Matrix2d answer_;
  Eigen::Vector2d mean_;
  Eigen::Matrix2d covariance_;
  Eigen::ArrayXd tangent_x_, tangent_y_;
  Eigen::Vector2d vertical_;  // the vertical error per depth and tangent
};

BeamUncertainty Uncertainty(const Sample& sample, const Prediction& prediction,
                            const Eigen::Vector2d& azimuth, const std::vector<double>& depths) {
  BeamUncertainty result;
  result.refraction_along_wind = TwoSigma(sample.tangent_x.atan(), prediction.TangentX());
  result.refraction_cross_wind = TwoSigma(sample.tangent_y.atan(), prediction.TangentY());
  for (const double depth : depths) {
    const Eigen::ArrayXd x = sample.x_offset + depth * sample.x_per_depth;
    const Eigen::ArrayXd y = sample.y_offset + depth * sample.y_per_depth;
    const Eigen::ArrayXd z = sample.z_offset + depth * sample.z_per_depth;
    result.thu.push_back(TwoSigma(x, y, prediction.Horizontal(depth)));
    result.tvu.push_back(TwoSigma(z, prediction.Vertical(depth)));
    result.bias_along_beam.push_back(
        Mean(azimuth.x() * x + azimuth.y() * y, prediction.Along(azimuth, depth)));
    result.bias_vertical.push_back(Mean(z, prediction.Vertical(depth)));
  }
  return result;
}

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
      const Sample sample(realizations, b);
      const Eigen::Vector2d azimuth = beams[b].beam.azimuth_direction();
      result.beams.push_back(
          beams[b].mean_slope ? Uncertainty(sample, Prediction(beams[b], sample, encounter.refractive_index),
                                            azimuth, encounter.depths)
                              : Uncertainty(sample, azimuth, encounter.depths));
      result.converged = result.converged &&
                         (effort.relative_error == 0 || Meets(result.beams.back(), effort.relative_error));
    }
  } while (!result.converged && static_cast<int>(realizations.size()) < effort.most_realizations);
  result.realizations = static_cast<int>(realizations.size());
  return result;
}

}  // namespace albtpu
