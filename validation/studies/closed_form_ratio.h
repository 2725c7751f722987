// The Monte Carlo over the closed form, and how far apart they may be.
#pragma once

#include <cstdint>
#include <vector>

#include "generator/math/statistics.h"
#include "generator/monte_carlo/monte_carlo.h"

namespace albtpu {

// Of one beam.
struct ClosedFormRatio {
  Estimate along, cross, thu;
  Estimate tvu;    // not a number at nadir, where the closed form is zero
  double allowed;  // how far under 1 along, cross and THU may lie, standard errors aside
};

struct SeaCaseRatios {
  std::vector<ClosedFormRatio> beams;
  // Of all waves: those below the grid are not drawn, but what they do to refraction is.
  double mean_square_slope;
  // The slope variance that the footprint lets through, over the whole; the least of the beams.
  double seen_fraction;
};

// `sea case` has one depth, above 0.
SeaCaseRatios CompareWithClosedForm(const SeaCase& sea_case, int realizations, std::uint64_t seed,
                                    std::uint32_t cell);

// What grid, patch and rays may do to a standard deviation (discretization.h): each is chosen to some half a
// per cent of variance and a little more.
inline constexpr double kDiscretizationError = 0.005;

// How far under the small-slope theory ray tracing may lie, for Snell's law bends to that side only (over it,
// kDiscretizationError): 0.015 + 0.3 mss + 0.02 theta / 20 degrees.
double AllowedDeparture(double mean_square_slope, double incidence_degrees);

// So many standard errors that the greatest of this many normal departures exceeds them in one case of
// twenty.
double StandardErrorsFor(int comparisons);

// How far a ratio lies under 1 - allowed or over 1 + kDiscretizationError, in standard errors; not above 0 if
// within.
double ExcessInStandardErrors(const Estimate& ratio, double allowed);

}  // namespace albtpu
