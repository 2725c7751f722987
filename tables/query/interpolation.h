// The uncertainty of a pulse by multilinear interpolation in a table, each axis in its own scale.
#pragma once

#include "tables/pulse.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// Example:
//   auto table = ReadTable("quick.h5");
//   Pulse pulse = {.wind_speed = 5, .incidence = 20, .footprint = 0.5f, .depth = 8};
//   PulseUncertainty u = Interpolate(*table, pulse);
//   if (u.outcome == Outcome::kInterpolated) std::cout << u[Quantity::kThu] << " m\n";
PulseUncertainty Interpolate(const UncertaintyTable& table, const Pulse& pulse);

// The answer for a pulse without azimuth, from its answers at two azimuths, such as 0 and 90 degrees: each value is the
// larger in magnitude, with its standard error. Without numbers at both, the answer that has the worse outcome:
// kInvalid before kOutOfDomain, then the one whose axis comes first.
PulseUncertainty LargerOf(const PulseUncertainty& a, const PulseUncertainty& b);

}  // namespace albtpu
