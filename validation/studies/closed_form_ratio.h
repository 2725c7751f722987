// The ratio of the Monte Carlo to the closed form, and its bounds.
#pragma once

#include <cstdint>
#include <vector>

#include "generator/math/statistics.h"
#include "generator/monte_carlo/monte_carlo.h"

namespace albtpu {

// Of one beam.
struct ClosedFormRatio {
  Estimate along, cross, thu;
  Estimate tvu;    // NaN at nadir, where the closed form is zero
  double allowed;  // the bound by which along, cross and THU may be below 1, besides standard errors
};

struct SeaCaseRatios {
  std::vector<ClosedFormRatio> beams;
  // Of all waves: the waves shorter than the grid are not drawn, but their effect on refraction is included.
  double mean_square_slope;
  // The fraction of the slope variance that the footprint passes; the minimum of the beams.
  double seen_fraction;
};

// `sea_case` must have one depth, above 0.
SeaCaseRatios CompareWithClosedForm(const SeaCase& sea_case, int realizations, std::uint64_t seed, std::uint32_t cell);

// The relative error of a standard deviation that grid, patch and rays may cause (discretization.h): each of them is
// chosen for an error of half a per cent of the variance or a little more.
inline constexpr double kDiscretizationError = 0.005;

// The relative amount by which ray tracing may be below the small-slope theory, 0.015 + 0.3 mss + 0.02 theta / 20
// degrees. The nonlinearity of Snell's law only lowers it; above the theory kDiscretizationError is allowed.
double AllowedDeparture(double mean_square_slope, double incidence_degrees);

// The number of standard errors that the maximum of this many normal deviations exceeds with a probability of 5 %.
double StandardErrorsFor(int comparisons);

// The distance, in standard errors, of a ratio below 1 - allowed or above 1 + kDiscretizationError; 0 or negative
// within these bounds.
double ExcessInStandardErrors(const Estimate& ratio, double allowed);

}  // namespace albtpu
