// A laser beam on the water: where it points, how wide it is, and what its footprint averages.
#pragma once

#include <limits>

namespace albtpu {

enum class BeamProfile {
  kUniform,   // even irradiance within the diameter
  kGaussian,  // the diameter is where the irradiance falls to 1/e^2 of the centre's
};

struct BeamOptions {
  double incidence = 0;  // rad from the vertical, in air, 0 to below pi/2
  double azimuth = 0;    // rad from downwind, of the horizontal direction of travel
  double footprint = 0;  // m, diameter at the mean surface, across the axis
  BeamProfile profile = BeamProfile::kUniform;
  double source_height = std::numeric_limits<double>::infinity();  // m above the water; infinity: collimated
};

// The radius, over the footprint's diameter, within which lies the fraction `power` of the beam, from 0 to
// below 1.
double RadiusOfPower(BeamProfile profile, double power);

// What the footprint's average leaves of a wave with wavenumber `k` [rad/m] travelling at `psi` [rad] from
// downwind: W of the small-slope theory. The footprint on the water is an ellipse, longer by 1/cos(incidence)
// along the azimuth. With kappa = sqrt((k_along / cos(incidence))^2 + k_across^2), W = 2 J1(kappa D/2) /
// (kappa D/2) for a uniform beam and exp(-kappa^2 D^2 / 32) for a gaussian one.
double FootprintAverage(const BeamOptions& beam, double k, double psi);

// Its square, the part of the wave's power that is left.
double FootprintPower(const BeamOptions& beam, double k, double psi);

}  // namespace albtpu
