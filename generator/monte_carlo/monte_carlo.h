// The Monte Carlo: the uncertainty of beams from many realizations of one sea.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "generator/monte_carlo/beam_uncertainty.h"
#include "generator/surface/beam.h"
#include "generator/surface/discretization.h"
#include "sea/sea_state.h"
#include "sea/water_index.h"

namespace albtpu {

enum class Estimator {
  kControlVariate,  // known statistics of the surface's slopes, with the departures from them by tracing
  kPlain,           // tracing alone, the slow twin
};
std::string_view Name(Estimator estimator);  // "control_variate", "plain"
std::optional<Estimator> FindEstimator(std::string_view name);

// When to stop. Realizations beyond the first `realizations` come in whole batches of `kBatch`. Each beam stops on its
// own; all beams share the surfaces.
struct Effort {
  int realizations = 1000;       // lower bound, 2 or more
  int most_realizations = 1000;  // upper bound
  // Continue until the standard errors of refraction, THU and TVU, relative to their values, are at most this large.
  // Values below 0.009 degrees or 0.9 mm do not count. 0 disables the criterion.
  double relative_error = 0;
  Estimator estimator = Estimator::kControlVariate;
};
inline constexpr int kBatch = 64;

// One sea with all beams that are traced on the same surfaces: they share footprint, profile and source.
struct SeaCase {
  SeaOptions sea;
  double refractive_index = kRefractiveIndex;
  std::vector<BeamOptions> beams;                // not empty
  std::vector<double> depths;                    // m, not negative
  std::optional<int> rays;                       // of each beam; chosen from sea and beams where absent
  std::optional<Discretization> discretization;  // chosen from sea and beams where absent
};

struct SeaCaseResult {
  std::vector<BeamUncertainty> beams;
  int realizations = 0;   // the maximum of all beams; 0 for a sea without waves, whose result is exact
  bool converged = true;  // false when `most_realizations` was reached before `relative_error`
  // The discretization of the surface; 0 for a sea without waves.
  int rays = 0;
  double patch_length = 0, spacing = 0;  // m
  // Slope variance of the facets over the footprint, divided by that of the closed form; the minimum of the beams.
  double footprint_slope_fraction = 0;
  double resolved_slope_fraction = 0;  // mean square slope of the facets, divided by that of the sea
};

// Slopes along a beam up to this many of their standard deviations must face it: each ray then meets one facet, but for
// 1e-4 of the surface, which is hidden behind other waves (Smith (1967), doi:10.1109/TAP.1967.1138991).
inline constexpr double kFacingDeviations = 3;
// A point source stands above crests of so many standard deviations of the surface's elevation.
inline constexpr double kCrestDeviations = 6;

// InvalidArgument if a beam is so far from the vertical that waves hide behind each other, or its source stands below
// crests; the message says what would be right.
absl::Status CheckTraceable(const SeaCase& sea_case);

// Requires CheckTraceable, otherwise values may be wrong or not finite. Runs on all threads of the current TBB arena.
// The result is a function of its arguments alone.
SeaCaseResult Simulate(const SeaCase& sea_case, const Effort& effort, std::uint64_t seed, std::uint32_t cell);

}  // namespace albtpu
