#include <cmath>

#include "generator/monte_carlo/beam_tracing.h"
#include "generator/surface/ray_tracer.h"

namespace albtpu {
namespace {

class PlainTracing final : public BeamTracing {
 public:
  PlainTracing(const SurfaceModel& model, const TracedBeams& traced)
      : model_(model), refractive_index_(traced.refractive_index) {
    for (const BeamOptions& options : traced.beams) {
      Beam beam(options, traced.rays);
      std::vector<Ray> rays = beam.Rays(0);
      TracedBeam still = Trace(rays, model.StillSurface(), refractive_index_);
      beams_.push_back(
          {std::move(beam), std::move(rays), still,
           EffectOfUnresolvedWaves(options, refractive_index_, traced.unresolved_slopes, traced.resolved_slopes)});
    }
  }

  void Realize(const NormalStream& stream, const std::vector<bool>& wanted,
               std::vector<BeamRealization>& realized) const override {
    const SeaSurface surface(model_, stream);
    for (std::size_t b = 0; b < beams_.size(); ++b) {
      if (!wanted[b]) continue;
      const PreparedBeam& prepared = beams_[b];
      const BeamOptions& options = prepared.beam.options();
      if (b > 0 && wanted[b - 1] && options.incidence == 0 && beams_[b - 1].beam.options().incidence == 0) {
        realized[b] = realized[b - 1];
        continue;
      }
      const SeaSurface::LocalSurface local = surface.SurfaceUnder(prepared.beam);
      const TracedBeam traced =
          Trace(std::isinf(options.source_height) ? prepared.rays : prepared.beam.Rays(local.elevation), local.heights,
                refractive_index_);
      realized[b].parts[0] = {1, ErrorsOf(WithUnresolvedWaves(traced, prepared.unresolved), prepared.still_water)};
    }
  }

  const std::optional<KnownSlopes>& known_slopes(std::size_t) const override { return nothing_; }

 private:
  struct PreparedBeam {
    Beam beam;
    std::vector<Ray> rays;  // of a collimated beam; the rays of a point source depend on the elevation
    TracedBeam still_water;
    UnresolvedWaves unresolved;
  };

  const SurfaceModel& model_;
  double refractive_index_;
  std::vector<PreparedBeam> beams_;
  std::optional<KnownSlopes> nothing_;
};

}  // namespace

std::unique_ptr<BeamTracing> MakePlainTracing(const SurfaceModel& model, const TracedBeams& traced) {
  return std::make_unique<PlainTracing>(model, traced);
}

}  // namespace albtpu
