// The Monte Carlo: beams through many realizations of one sea, and the uncertainty that comes out.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "generator/monte_carlo/beam_uncertainty.h"
#include "generator/surface/beam.h"
#include "generator/surface/discretization.h"
#include "sea/sea_state.h"

namespace albtpu {

enum class Estimator {
  kControlVariate,  // what is known of each surface's slopes, and by tracing what differs from it
  kPlain,           // tracing alone: the slow twin
};
std::string_view Name(Estimator estimator);  // "control_variate", "plain"
std::optional<Estimator> FindEstimator(std::string_view name);

// How long to go on. Realizations beyond the first are counted in whole batches of `kBatch`; every beam goes
// on for itself, on the surfaces that all share.
struct Effort {
  int realizations = 1000;       // at least so many, 2 or more
  int most_realizations = 1000;  // and no more
  // Go on until refraction, THU and TVU have this standard error over their value, where they are 0.01
  // degrees or 1 mm and more; 0: don't.
  double relative_error = 0;
  Estimator estimator = Estimator::kControlVariate;
};
inline constexpr int kBatch = 64;

// Seas and beams that share their surfaces: one footprint and profile.
struct SeaCase {
  SeaOptions sea;
  double refractive_index = 1.33;
  std::vector<BeamOptions> beams;                // not empty; the same footprint, profile and source
  std::vector<double> depths;                    // m, not negative
  std::optional<int> rays;                       // of each beam; chosen from sea and beams where absent
  std::optional<Discretization> discretization;  // chosen from sea and beams where absent
};

struct SeaCaseResult {
  std::vector<BeamUncertainty> beams;
  int realizations = 0;   // the most of any beam
  bool converged = true;  // false: `most_realizations` came before `relative_error`
  // What the surface was.
  int rays = 0;
  double patch_length = 0, spacing = 0;  // m
  // Slope variance that the facets show the footprint, over that of the closed form; the least of the beams.
  double footprint_slope_fraction = 0;
  double resolved_slope_fraction = 0;  // mean square slope of the facets, over the sea's
};

// Runs on all threads of the current TBB arena. The result is a function of its arguments alone.
SeaCaseResult Simulate(const SeaCase& sea_case, const Effort& effort, std::uint64_t seed, std::uint32_t cell);

}  // namespace albtpu
