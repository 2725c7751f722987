#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

#include "generator/kernels/fast_surface.h"
#include "generator/kernels/packet_tracer.h"
#include "generator/monte_carlo/beam_tracing.h"
#include "generator/monte_carlo/height_slope_product.h"
#include "generator/surface/ray_tracer.h"
#include "sea/response/refraction.h"
#include "sea/response/unresolved_waves.h"

namespace albtpu {
namespace {

// A beam with what does not change from realization to realization.
struct PreparedBeam {
  BeamOptions options;
  Eigen::Vector2d per_height;
  RayBundle rays;
  TracedBeam still_water;
  UnresolvedWaves unresolved;
  std::optional<KnownSlopes> known;
};

// E[(1 - per_height . long slope) mean slope] over the surfaces: slopes go together with those of the same
// waves.
Eigen::Vector2d ExpectedSlope(const LongWaveModel& long_waves, const BeamOptions& beam,
                              const Eigen::Vector2d& per_height) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const LongWaveModel::Wave& wave : long_waves.waves()) {
    const double psi = std::atan2(wave.wavenumber.y(), wave.wavenumber.x());
    sum -= wave.variance * wave.wavenumber.dot(per_height) *
           FootprintAverage(beam, wave.wavenumber.norm(), psi) * wave.wavenumber;
  }
  return sum;
}

class AntitheticTracing final : public BeamTracing {
 public:
  AntitheticTracing(const SurfaceModel& model, const TracedBeams& traced) : window_(model) {
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
                            EffectOfUnresolvedWaves(options, n, traced.unresolved_slopes),
                            {}};
      if (b > 0 && OneBeam(beams_.back().options, options)) {
        prepared.known = beams_.back().known;
      } else {
        prepared.known = {MomentsOfSlopes(correlation, rays[b], spacing,
                                          SecantCurvature(options.incidence, options.azimuth, n)),
                          FootprintSlopeCovariance(correlation, options, spacing),
                          height_slope.Covariance(options),
                          ExpectedSlope(model.long_waves(), options, per_height)};
      }
      beams_.push_back(std::move(prepared));
    }
  }

  void Realize(const NormalStream& stream, const std::vector<bool>& wanted,
               std::vector<BeamRealization>& realized) const override {
    Workspace& workspace = workspaces_.local();
    window_.Draw(stream, workspace.window);
    const std::vector<float>& heights = workspace.window.heights;
    workspace.turned.resize(heights.size());
    std::transform(heights.begin(), heights.end(), workspace.turned.begin(), std::negate<>());
    const int points = window_.points();
    const HeightView upright{heights.data(), points, points, window_.spacing()};
    const HeightView turned{workspace.turned.data(), points, points, window_.spacing()};
    for (std::size_t b = 0; b < beams_.size(); ++b) {
      if (!wanted[b]) continue;
      const PreparedBeam& beam = beams_[b];
      if (b > 0 && wanted[b - 1] && OneBeam(beams_[b - 1].options, beam.options)) {
        realized[b] = realized[b - 1];
        continue;
      }
      const double lean = beam.per_height.dot(workspace.window.long_slope);
      const auto part = [&](double weight, const TracedBeam& traced) {
        return BeamRealization::Part{
            0.5 * weight, ErrorsOf(WithUnresolvedWaves(traced, beam.unresolved), beam.still_water)};
      };
      const TracedBundle first = TracePackets(beam.rays, upright);
      realized[b].parts = {part(1 - lean, first.beam), part(1 + lean, Trace(beam.rays, turned))};
      realized[b].mean_slope = first.unshifted_slope;
      realized[b].mean_squares = first.unshifted_slope_squares;
      realized[b].height_slope = first.unshifted_height_slope;
    }
  }

  const std::optional<KnownSlopes>& known_slopes(std::size_t beam) const override {
    return beams_[beam].known;
  }

 private:
  struct Workspace {
    FastSurface::Workspace window;
    std::vector<float> turned;
  };

  // At nadir there is no azimuth: one beam stands for those of all azimuths.
  static bool OneBeam(const BeamOptions& a, const BeamOptions& b) {
    return a.incidence == 0 && b.incidence == 0;
  }

  FastSurface window_;
  std::vector<PreparedBeam> beams_;
  mutable tbb::enumerable_thread_specific<Workspace> workspaces_;
};

}  // namespace

std::unique_ptr<BeamTracing> MakeAntitheticTracing(const SurfaceModel& model, const TracedBeams& traced) {
  return std::make_unique<AntitheticTracing>(model, traced);
}

}  // namespace albtpu
