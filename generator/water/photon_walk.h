// Photons on their way down through water: the phase function by which they scatter, and walks in units of length that
// do not depend on the water for a given phase function.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sea/water_index.h"

namespace albtpu {

// The scattering of light by water: phase functions, their moments, and random angles from them.

// A phase function that depends on the angle psi [radian, 0 to pi] between the directions before and after alone. The
// fraction that is scattered by less than psi is known in closed form for both; everything else follows from it.
//
//     const PhaseFunction ocean = PhaseFunction::FournierForand(0.0183);  // Petzold's mean ocean particle
//     const double sine = ocean.SinHalf(uniform);                        // sin(psi / 2) of a scattered photon
class PhaseFunction {
 public:
  // Fournier and Jonasz (1999), doi:10.1117/12.366488, with the index of the particles and the slope of their sizes on
  // the line that Mobley et al. (2002), doi:10.1364/AO.41.001035, draw through the (backscatter fraction, shape) of
  // natural water: n = 1.01 + 0.1542 (mu - 3). `backscatter_fraction` is the fraction beyond 90 degrees, 0.001 to 0.2.
  static PhaseFunction FournierForand(double backscatter_fraction);
  // Henyey and Greenstein (1941). `g` is the mean cosine, in (0, 1). Without the forward peak of water: for tests.
  static PhaseFunction HenyeyGreenstein(double g);
  // Any other: `share_below` psi, not decreasing, 1 at pi.
  explicit PhaseFunction(const std::function<double(double)>& share_below);

  double BackscatterFraction() const { return 1 - ShareBelow(kRightAngle); }
  // The fraction that is scattered by less than `psi`; linear in sin^2(psi / 2) between close nodes.
  double ShareBelow(double psi) const;
  // The expectation of the Legendre polynomials P1 (the mean cosine) and P2, and of psi^2 [radian^2].
  double MeanCosine() const;
  double MeanSecondLegendre() const;
  double MeanSquareAngle() const;

  // sin(psi / 2) of the angle psi below which the fraction `share` in [0, 1) of the light is scattered.
  double SinHalf(double share) const;

 private:
  static constexpr double kRightAngle = 1.5707963267948966;

  template <typename Value>
  double Mean(const Value& value) const;

  // At nodes of the angle: psi, sin^2(psi / 2), and the fraction below. The first node is 0.
  std::vector<double> psi_, sin2_half_, share_;
  std::vector<std::uint32_t> guide_;  // The last node whose fraction is not above i / (size - 1).
};

// Photons on their way down through water, in units of length that do not depend on the water for a given phase
// function.
//
// The walk scatters once per unit of length on average (b = 1) and absorbs nothing. Where a real water scatters b times
// a metre, a photon has walked its path times 1 / b m; in water of absorption a the fraction exp(-a / b path) of it
// remains. So one pool of photons serves every depth, attenuation and albedo.

// The photons of a pool that reached a plane, where each met it first. Lengths in mean free paths of scattering.
struct Crossings {
  double depth = 0;             // of the plane
  std::uint32_t launched = 0;   // photons at the surface
  std::vector<float> excess;    // path down to it less depth / cos(refracted)
  std::vector<float> ahead;     // along the beam, from where unscattered light meets it
  std::vector<float> sideways;  // across the beam
  // The ways along and across the beam for each length down, in the direction in which it met the plane.
  std::vector<float> forward, sidelong;
};

struct WalkSetup {
  double refracted = 0;                      // angle in the water, from the vertical [radian, 0 to 1]
  double refractive_index = kSeaWaterIndex;  // of phase: the surface reflects from below beyond its critical angle
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
std::vector<Crossings> WalkPhotons(const PhaseFunction& phase, const WalkSetup& setup, std::span<const double> depths,
                                   std::uint32_t photons, std::uint64_t seed, std::uint32_t cell, std::uint32_t pool);

// A direction as unit vector (x ahead, y sideways, z down), and turning it by a scattering angle.
struct Heading {
  double x = 0, y = 0, z = 1;

  // `sin_half` of the angle, and `turn` [radian] around the old direction.
  void Scatter(double sin_half, double turn);
};

}  // namespace albtpu
