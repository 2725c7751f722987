// A laser beam on the water: its direction, its width, the shape of its irradiance, and what its footprint averages.
#pragma once

#include <limits>
#include <optional>
#include <string_view>

namespace albtpu {

enum class BeamProfile {
  kUniform,   // even irradiance within the diameter
  kGaussian,  // at the diameter the irradiance falls to 1/e^2 of that at the centre
};
std::string_view Name(BeamProfile profile);  // "uniform", "gaussian"
std::optional<BeamProfile> FindBeamProfile(std::string_view name);

struct BeamOptions {
  double incidence = 0;  // rad from the vertical, in air, 0 to below pi/2
  double azimuth = 0;    // rad from downwind, of the horizontal direction of travel
  double footprint = 0;  // m, diameter at the mean surface, across the axis
  BeamProfile profile = BeamProfile::kUniform;
  double source_height =
      std::numeric_limits<double>::infinity();  // m above the water; infinity means collimated
};

// Lengths across the beam, in diameters, in the next three. See "The profile of a footprint" in docs/physics.md.

// The irradiance over that at the centre, at the distance whose square is `squared_radius`: 1 within 1/2 and 0 beyond
// it for a uniform beam, exp(-8 r^2) for a gaussian one.
double RelativeIrradiance(BeamProfile profile, double squared_radius);

// The radius of the circle that holds the fraction `power` of the beam, from 0 to below 1: sqrt(power) / 2 for a
// uniform beam, sqrt(-ln(1 - power) / 8) for a gaussian one.
double RadiusOfPower(BeamProfile profile, double power);

// The autocorrelation of the irradiance, the integral of I(x) I(x + a) over that of I(x)^2, at the distance |a| =
// `apart`: how much of the footprint still lies over itself after a shift. 2/pi (acos a - a sqrt(1 - a^2)) for a
// uniform beam, 0 from a = 1 on; exp(-4 a^2) for a gaussian one.
double FootprintOverlap(BeamProfile profile, double apart);

// The length [m] of the footprint on the water along its longer axis. Across the beam a uniform beam is one diameter
// wide, a gaussian one two, which hold all but exp(-8) = 3e-4 of its power; on the water both are longer by
// 1 / cos(incidence).
double WidthOnWater(const BeamOptions& beam);

// The factor W by which averaging over the footprint reduces a wave of wavenumber `k` [rad/m] that travels towards
// `psi` [rad] from downwind. The footprint on the water is an ellipse, longer by 1/cos(incidence) along the azimuth.
// With kappa = sqrt((k_along / cos(incidence))^2 + k_across^2) and the diameter D, W = 2 J1(kappa D/2) / (kappa D/2)
// for a uniform beam and exp(-kappa^2 D^2 / 32) for a gaussian one.
double FootprintAverage(const BeamOptions& beam, double k, double psi);

// W^2, the fraction of the wave's power that remains.
double FootprintPower(const BeamOptions& beam, double k, double psi);

}  // namespace albtpu
