// The slow twin of the water column's Monte Carlo: every photon goes down, off the bottom and up again, and counts if
// it leaves the water within the field of view and the cone of the receiver. No reciprocity, no pairs, no scaling, and
// independent code.
#pragma once

#include <cstdint>
#include <vector>

#include "generator/water/echo.h"
#include "generator/water/phase_function.h"
#include "validation/studies/traveller.h"

namespace albtpu {

// Echoes as PairPhotons gives them, one for each pool of `photons` photons; their energy is relative to the light that
// an unscattered beam sends into the cone.
std::vector<Echo> TraceRoundTrips(const PhaseFunction& phase, const RoundTrip& trip, double step,
                                  std::uint32_t pools, std::uint32_t photons, std::uint64_t seed);

}  // namespace albtpu
