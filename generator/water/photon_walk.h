// Photons on their way down through water, in units of length that do not depend on the water for a given phase
// function.
//
// The walk scatters once per unit of length on average (b = 1) and absorbs nothing. Where a real water scatters b times
// a metre, a photon has walked its path times 1 / b m; in water of absorption a the fraction exp(-a / b path) of it
// remains. So one pool of photons serves every depth, attenuation and albedo.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "generator/water/phase_function.h"

namespace albtpu {

// The photons of a pool that reached a plane, where each met it first. Lengths in mean free paths of scattering.
struct Crossings {
  double depth = 0;             // of the plane
  std::uint32_t launched = 0;   // photons at the surface
  std::vector<float> excess;    // path down to it less depth / cos(refracted)
  std::vector<float> ahead;     // along the beam, from where unscattered light meets it
  std::vector<float> sideways;  // across the beam
};

struct WalkSetup {
  double refracted = 0;            // angle in the water, from the vertical [radian, 0 to 1]
  double refractive_index = 1.34;  // of phase: the surface reflects from below beyond its critical angle
  // Half angle [radian] of a cone around the beam, from which photons start as a diffuse surface emits them; a tube
  // that accepts such a cone receives what leaves the water within it. 0: all start along the beam.
  double cone = 0;
  // Photons with a larger excess are dropped: choose it so that absorption has left nothing.
  double longest_excess = 1e6;
};

// `photons` photons from one point of the surface, each by its own stream (seed, cell, photon, pool). They are followed
// until they have passed the last of `depths` (increasing, positive) or left through the surface. Light that the
// surface does not reflect totally is lost; it returns to the receiver early or never. Element i of the result belongs
// to depths[i].
std::vector<Crossings> WalkPhotons(const PhaseFunction& phase, const WalkSetup& setup,
                                   std::span<const double> depths, std::uint32_t photons, std::uint64_t seed,
                                   std::uint32_t cell, std::uint32_t pool);

// A direction as unit vector (x ahead, y sideways, z down), and turning it by a scattering angle.
struct Heading {
  double x = 0, y = 0, z = 1;

  // `sin_half` of the angle, and `turn` [radian] around the old direction.
  void Scatter(double sin_half, double turn);
};

}  // namespace albtpu
