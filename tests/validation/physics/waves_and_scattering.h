// A simulation of a rough surface over turbid water, compared with each of the two alone.
#pragma once

#include <array>
#include <cstdint>

#include "generator/water/bottom_detector.h"
#include "generator/water/photon_walk.h"
#include "validation/studies/water_round_trip.h"

namespace albtpu {

struct WavesAndScattering {
  RoundTrip trip;          // over a level bottom; the cone is not used
  double nanoseconds = 5;  // of the pulse at half its maximum
  double wind = 5;         // m/s, of a fully grown sea, along the beam
};

// The reported bottom minus the true one [m], in the plane of the beam: moments over realizations of the sea. Waves
// shorter than two hundredths of the field of view are left out.
struct ReportedBottom {
  double mean_along = 0, mean_vertical = 0;    // of the bias: along the beam, and positive too shallow
  double sigma_along = 0, sigma_vertical = 0;  // standard deviations
};

struct ComparedEffects {
  std::array<ReportedBottom, 3> waves, scattering, both;  // by Detector
};

// Photons of the beam and photons traced backwards from the receiver enter through the same waves and meet on the
// bottom. Each realization has two sets of photons. Covariances between the two are variances over the sea, without the
// noise of the photons.
ComparedEffects Compare(const PhaseFunction& phase, const WavesAndScattering& at, int realizations, int photons,
                        std::uint64_t seed);

}  // namespace albtpu
