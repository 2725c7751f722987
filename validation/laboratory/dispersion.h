// The dispersion of capillary-gravity waves on deep, clean, fresh water, and the spectrum over frequency that
// follows.
//
//     omega^2 = g k + (T / rho) k^3
//
// A finite depth h multiplies both terms by tanh(k h). In the tank of Birkebak et al. (2018), 2.4 m deep,
// this factor is below 1 by 1e-9 for waves of 1.4 m and by less for shorter ones.
#pragma once

#include "sea/sea_state.h"

namespace albtpu {

inline constexpr double kSurfaceTension = 0.07274;  // N/m, pure water at 20 C: IAPWS R1-76 (2014)
inline constexpr double kWaterDensity = 998.2;      // kg/m^3, the same: IAPWS R6-95 (2018)

double AngularFrequency(double wavenumber);   // rad/s, of k in rad/m, not negative
double Wavenumber(double angular_frequency);  // rad/m, of omega in rad/s, not negative: the inverse
double GroupSpeed(double wavenumber);         // d omega / d k, m/s; k above 0

// The spectrum of elevation over frequency at one point, S(f) = 2 pi S(k) / (d omega / d k) [m^2/Hz], with k from the
// dispersion: its integral over f is that of S(k) over k. `frequency` in Hz, above 0.
double FrequencySpectrum(const SeaState& sea, double frequency);

// The frequency [Hz] of its maximum.
double PeakFrequency(const SeaState& sea);

}  // namespace albtpu
