// The wind at 10 m where it was not measured there: from the waves, or from an anemometer at another height.
#pragma once

#include <optional>

#include "sea/spectra/frequency_spectrum.h"

namespace albtpu {

// The friction velocity u* [m/s] of the wind that keeps the waves between 0.2 and 0.4 Hz in equilibrium,
// u* = 2 pi^3 <E f^4> / (beta I g) with beta = 0.012 and I = 2.5. None if the spectrum does not reach 0.2 Hz.
//
// Source: Thomson et al. (2013), doi:10.1002/2013JC008837, after Phillips (1985). The result is wrong
// where swell reaches above 0.2 Hz, and where the wind has just begun to raise the waves.
std::optional<double> EquilibriumFrictionVelocity(const FrequencySpectrum& spectrum);

// The wind at 10 m [m/s] that has this friction velocity [m/s]: the inverse of FrictionVelocity().
double WindSpeedOfFrictionVelocity(double friction_velocity);

// The wind at 10 m [m/s] that is `wind_speed` [m/s] at `height` [m, 1 to 100]: the inverse of WindSpeedAt().
double WindSpeedAt10m(double wind_speed, double height);

}  // namespace albtpu
