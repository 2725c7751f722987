// All beams of a sea case through one realization of its sea after another.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "generator/math/random_stream.h"
#include "generator/monte_carlo/beam_errors.h"
#include "generator/monte_carlo/beam_uncertainty.h"
#include "generator/surface/beam.h"
#include "generator/surface/sea_surface.h"

namespace albtpu {

// What to trace through: `beams` of one footprint, profile and source, each of `rays` rays.
struct TracedBeams {
  std::vector<BeamOptions> beams;
  double refractive_index;
  int rays;
  Eigen::Matrix2d unresolved_slopes;  // covariance of the slopes that are shorter than the grid
};

// Immutable.
class BeamTracing {
 public:
  virtual ~BeamTracing() = default;

  // The realization of the sea that `stream` draws, for those beams that are `wanted`; the others are left alone in
  // `realized`. As many of each as beams. A function of its arguments alone, on many threads.
  virtual void Realize(const NormalStream& stream, const std::vector<bool>& wanted,
                       std::vector<BeamRealization>& realized) const = 0;

  // Of each beam: nothing where tracing is all there is.
  virtual const std::optional<KnownSlopes>& known_slopes(std::size_t beam) const = 0;
};

// The slow twin: each beam meets the very surface at its place, in double precision, and nothing else is
// known of it. `model` must outlive it. Of beams at nadir, where there is no azimuth, the first stands for
// all.
std::unique_ptr<BeamTracing> MakePlainTracing(const SurfaceModel& model, const TracedBeams& traced);

// The fast one, for collimated beams: in single precision, many rays at a time. All beams share the surface
// about one point; how often each would meet it there is the weight of the realization (sea_surface.h), which
// is exact. The surface is traced both ways up, so that what is odd in its heights cancels, and its slopes
// are known beforehand.
std::unique_ptr<BeamTracing> MakeAntitheticTracing(const SurfaceModel& model, const TracedBeams& traced);

}  // namespace albtpu
