// The slow twin of the water column's Monte Carlo: every photon goes down, off the bottom and up again, and counts if
// it leaves the water where and whither the receiver sees it. No reciprocity, no pairs, no scaling, and its own
// arithmetic.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "generator/water/echo.h"
#include "generator/water/phase_function.h"

namespace albtpu {

// In metres and 1/m. The bottom is depth + slope * (x - x0), where x0 is met without scattering.
struct RoundTrip {
  double incidence = 0;  // in air [radian]
  double refractive_index = 1.34, group_index = 1.36;
  double scattering = 0.28, absorption = 0.07;
  double depth = 10, slope = 0;
  double field_of_view = 16, footprint = 0;
  double cone = 10 * M_PI / 180;  // half angle, in the water, in which the receiver accepts light [radian]
};

// Echoes as PairPhotons gives them, one for each pool of `photons` photons; their energy is relative to the light that
// an unscattered beam sends into the cone.
std::vector<Echo> TraceRoundTrips(const PhaseFunction& phase, const RoundTrip& trip, double step,
                                  std::uint32_t pools, std::uint32_t photons, std::uint64_t seed);

}  // namespace albtpu
