#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "generator/kernels/fast_surface.h"
#include "generator/kernels/packet_tracer.h"
#include "generator/monte_carlo/beam_tracing.h"
#include "generator/monte_carlo/slope_moments.h"
#include "generator/surface/ray_tracer.h"
#include "sea/response/closed_form.h"

namespace albtpu {
namespace {

// A beam with everything that is the same in all realizations.
struct PreparedBeam {
  BeamOptions options;
  Eigen::Vector2d per_height;
  RayBundle rays;
  TracedBeam still_water;
  UnresolvedWaves unresolved;
  std::optional<KnownSlopes> known;
};

// The expectation of the mean slope with the weight of FastSurface, E[(1 - p . long slope) mean slope], p being
// `per_height`. Only slopes of the same wave correlate: a wave of variance V and wavenumber k adds
// -V (k . p) W(k) k, where W is the footprint's average of the wave.
Eigen::Vector2d ExpectedSlope(const LongWaveModel& long_waves, const BeamOptions& beam,
                              const Eigen::Vector2d& per_height) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const LongWaveModel::Wave& wave : long_waves.waves()) {
    const double psi = std::atan2(wave.wavenumber.y(), wave.wavenumber.x());
    sum -= wave.variance * wave.wavenumber.dot(per_height) * FootprintAverage(beam, wave.wavenumber.norm(), psi) *
           wave.wavenumber;
  }
  return sum;
}

class AntitheticTracing final : public BeamTracing {
 public:
  AntitheticTracing(const SurfaceModel& model, const TracedBeams& traced) : surface_(model) {
    const double spacing = model.patch().spacing();
    const double n = traced.refractive_index;
    std::vector<std::vector<Ray>> rays;
    int reach = 0;
    for (const BeamOptions& options : traced.beams) {
      assert(std::isinf(options.source_height));
      rays.push_back(Beam(options, traced.rays).Rays(0));
      reach = std::max(reach, ReachOfRays(rays.back(), spacing));
    }
    const SurfaceCorrelation correlation(model, reach);
    const HeightSlopeProduct height_slope(correlation, spacing);
    for (std::size_t b = 0; b < rays.size(); ++b) {
      const BeamOptions& options = traced.beams[b];
      const Eigen::Vector2d per_height = rays[b].front().per_height();
      PreparedBeam prepared{options,
                            per_height,
                            RayBundle(rays[b], n),
                            Trace(rays[b], model.StillSurface(), n),
                            EffectOfUnresolvedWaves(options, n, traced.unresolved_slopes, traced.resolved_slopes),
                            {}};
      if (b > 0 && OneBeam(beams_.back().options, options)) {
        prepared.known = beams_.back().known;
      } else {
        prepared.known = {
            MomentsOfSlopes(correlation, rays[b], spacing, SecantCurvature(options.incidence, options.azimuth, n)),
            FootprintSlopeCovariance(correlation, options, spacing), height_slope.Covariance(options),
            ExpectedSlope(model.long_waves(), options, per_height)};
      }
      beams_.push_back(std::move(prepared));
    }
  }

  void Realize(const NormalStream& stream, const std::vector<bool>& wanted,
               std::vector<BeamRealization>& realized) const override {
    Workspace& workspace = workspaces_.local();
    surface_.Draw(stream, workspace.surface);
    const std::vector<float>& heights = workspace.surface.heights;
    workspace.inverted.resize(heights.size());
    std::transform(heights.begin(), heights.end(), workspace.inverted.begin(), std::negate<>());
    const int points = surface_.points();
    const HeightView upright{heights.data(), points, points, surface_.spacing()};
    const HeightView inverted{workspace.inverted.data(), points, points, surface_.spacing()};
    for (std::size_t b = 0; b < beams_.size(); ++b) {
      if (!wanted[b]) continue;
      const PreparedBeam& beam = beams_[b];
      if (b > 0 && wanted[b - 1] && OneBeam(beams_[b - 1].options, beam.options)) {
        realized[b] = realized[b - 1];
        continue;
      }
      // The weight of this surface is 1 - lean, that of the inverted one 1 + lean.
      const double lean = beam.per_height.dot(workspace.surface.long_slope);
      const auto part = [&](double weight, const TracedBeam& traced) {
        return BeamRealization::Part{0.5 * weight,
                                     ErrorsOf(WithUnresolvedWaves(traced, beam.unresolved), beam.still_water)};
      };
      const TracedBundle bundle = TracePackets(beam.rays, upright);
      realized[b].parts = {part(1 - lean, bundle.beam), part(1 + lean, Trace(beam.rays, inverted))};
      realized[b].mean_slope = bundle.unshifted_slope;
      realized[b].mean_squares = bundle.unshifted_slope_squares;
      realized[b].height_slope = bundle.unshifted_height_slope;
    }
  }

  const std::optional<KnownSlopes>& known_slopes(std::size_t beam) const override { return beams_[beam].known; }

 private:
  struct Workspace {
    FastSurface::Workspace surface;
    std::vector<float> inverted;
  };

  // At nadir the azimuth has no meaning: one beam stands for all azimuths.
  static bool OneBeam(const BeamOptions& a, const BeamOptions& b) { return a.incidence == 0 && b.incidence == 0; }

  FastSurface surface_;
  std::vector<PreparedBeam> beams_;
  mutable tbb::enumerable_thread_specific<Workspace> workspaces_;
};

}  // namespace

std::unique_ptr<BeamTracing> MakeAntitheticTracing(const SurfaceModel& model, const TracedBeams& traced) {
  return std::make_unique<AntitheticTracing>(model, traced);
}

}  // namespace albtpu
