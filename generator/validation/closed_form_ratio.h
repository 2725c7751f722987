// The Monte Carlo over the closed form, and how far apart they may be.
#pragma once

#include <cstdint>
#include <vector>

#include "generator/monte_carlo.h"
#include "generator/statistics.h"

namespace albtpu {

// Of one beam.
struct ClosedFormRatio {
  Estimate along, cross, thu;
  Estimate tvu;  // not a number at nadir, where the closed form is zero
  // How far from 1 along, cross and THU may lie for the nonlinearity of Snell's law, standard errors aside.
  double allowed;
};

struct EncounterRatios {
  std::vector<ClosedFormRatio> beams;
  double
      mean_square_slope;  // of all waves: those below the grid are not drawn, but what they do to refraction is
  // The slope variance that the footprint lets through, over the whole; the least of the beams.
  double seen_fraction;
};

// `encounter` has one depth, above 0.
EncounterRatios CompareWithClosedForm(const Encounter& encounter, int realizations, std::uint64_t seed,
                                      std::uint32_t cell);

// Ray tracing lies under the small-slope theory by 0.5-1.5 % and 0.3 times the mean square slope, and by some
// 2 % more at 20 degrees: 0.015 + 0.3 mss + 0.02 theta / 20 degrees.
double AllowedDeparture(double mean_square_slope, double incidence_degrees);

// A footprint that sees less than this part of the slope variance sees still water: the Monte Carlo does not
// refine its grid for the sake of what is left (discretization.cc), and nobody needs to know it.
inline constexpr double kLeastSeenFraction = 3e-5;

// So many standard errors that the greatest of this many normal departures exceeds them in one case of
// twenty.
double StandardErrorsFor(int comparisons);

// Departure of a ratio from 1 beyond what is allowed, in standard errors; not above 0 if within.
double ExcessInStandardErrors(const Estimate& ratio, double allowed);

}  // namespace albtpu
