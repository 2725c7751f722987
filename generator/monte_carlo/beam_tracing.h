// Traces all beams of a sea case through one realization of the sea after another.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "generator/math/random_stream.h"
#include "generator/monte_carlo/beam_uncertainty.h"
#include "generator/surface/beam.h"
#include "generator/surface/sea_surface.h"

namespace albtpu {

// The beams to trace. All share footprint, profile and source.
struct TracedBeams {
  std::vector<BeamOptions> beams;
  double refractive_index;
  int rays;                           // of each beam
  Eigen::Matrix2d unresolved_slopes;  // slope covariance of the waves shorter than the grid
  Eigen::Matrix2d resolved_slopes;    // of the facets
};

// Immutable.
class BeamTracing {
 public:
  virtual ~BeamTracing() = default;

  // Draws one realization of the sea from `stream` and traces the beams that are `wanted`; the elements of `realized`
  // for other beams are not changed. `wanted` and `realized` have one element for each beam. The result is a function
  // of the arguments alone; may be called on many threads at once.
  virtual void Realize(const NormalStream& stream, const std::vector<bool>& wanted,
                       std::vector<BeamRealization>& realized) const = 0;

  // The known statistics of a beam's slopes. Absent where only tracing is used.
  virtual const std::optional<KnownSlopes>& known_slopes(std::size_t beam) const = 0;
};

// The slow twin: tracing alone, in double precision, each beam at its own point of the surface. `model` must outlive
// it. At nadir, where the azimuth has no meaning, the first of consecutive beams stands for all.
std::unique_ptr<BeamTracing> MakePlainTracing(const SurfaceModel& model, const TracedBeams& traced);

// The fast tracing of collimated beams, in single precision and with many rays at a time. All beams share the surface
// about one point, and each weights it by the probability of meeting the water there (fast_surface.h), which is exact.
// The surface is also traced upside down, so that effects odd in the heights cancel. The statistics of its slopes are
// known.
std::unique_ptr<BeamTracing> MakeAntitheticTracing(const SurfaceModel& model, const TracedBeams& traced);

}  // namespace albtpu
