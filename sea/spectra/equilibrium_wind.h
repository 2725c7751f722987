// Winds that nobody measured at 10 m: from the waves, or from an anemometer near the water.
#pragma once

#include <optional>

#include "sea/spectra/frequency_spectrum.h"

namespace albtpu {

// The friction velocity u* [m/s] of the wind that keeps the waves between 0.2 and 0.4 Hz in equilibrium,
// u* = 2 pi^3 <E f^4> / (beta I g) with beta = 0.012 and I = 2.5. None if the spectrum does not reach 0.2 Hz.
//
// Source: Thomson et al. (2013), doi:10.1002/2013JC008837, after Phillips (1985). Swell that reaches above 0.2 Hz, and
// waves that the wind has just begun to raise, are mistaken for others.
std::optional<double> EquilibriumFrictionVelocity(const FrequencySpectrum& spectrum);

// The wind at 10 m [m/s] of which FrictionVelocity() makes this friction velocity.
double WindSpeedOfFrictionVelocity(double friction_velocity);

// The wind at 10 m [m/s] of which WindSpeedAt() makes `wind_speed` at `height` [m, 1 to 100].
double WindSpeedAt10m(double wind_speed, double height);

}  // namespace albtpu
