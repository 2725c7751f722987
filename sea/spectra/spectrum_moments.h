// The dispersion relations of gravity and of capillary-gravity waves, and the moments of a spectrum in samples of
// wavenumber by the trapezoidal rule in k.
#pragma once

#include <limits>

#include "sea/spectra/harmonic_spectrum.h"

namespace albtpu {

// The dispersion relation of gravity waves in water of constant depth without current: omega^2 = g k tanh(k h).
//
// Source: any text of water waves, for example Dean and Dalrymple (1991), Water Wave Mechanics, Eq. 3.34. Depths are in
// m, above 0; infinity means deep water.

// k [rad/m] of waves of frequency `f` [Hz, above 0], to 1e-14 of itself.
double WavenumberOfFrequency(double f, double depth);

// f [Hz] of waves of wavenumber `k` [rad/m, above 0].
double FrequencyOfWavenumber(double k, double depth);

// df/dk [Hz m/rad], the group velocity over 2 pi, of waves of wavenumber `k`: E(f) df/dk is S(k).
double FrequencySlope(double k, double depth);

// 2 k h / sinh(2 k h): 0 in deep water, 1 in shallow.
double Shallowness(double k, double depth);

// Capillary-gravity waves on clean, fresh water: omega^2 = (g k + (T / rho) k^3) tanh(k h). The phase speed has its
// minimum at 367 rad/m.

inline constexpr double kSurfaceTension = 0.07274;  // N/m, pure water at 20 C: IAPWS R1-76 (2014)
inline constexpr double kWaterDensity = 998.2;      // kg/m^3, the same: IAPWS R6-95 (2018)

// omega [rad/s] of k [rad/m], not negative, in water of `depth` [m, above 0].
double AngularFrequency(double k, double depth = std::numeric_limits<double>::infinity());

double ElevationVariance(const HarmonicSpectrum& spectrum);  // m^2, the integral of S dk

// 4 sqrt(m0) [m]. Stations may state the mean of the highest third of waves instead, which is some 5 % less.
double SignificantWaveHeight(const HarmonicSpectrum& spectrum);

double MeanSquareSlope(const HarmonicSpectrum& spectrum);  // the integral of k^2 S dk

// The same for waves with wavenumbers below `k` [rad/m].
double MeanSquareSlopeBelow(const HarmonicSpectrum& spectrum, double k);

}  // namespace albtpu
