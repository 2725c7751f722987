// Moments of a spectrum in samples of wavenumber, by the trapezoidal rule in k.
#pragma once

#include "sea/spectra/harmonic_spectrum.h"

namespace albtpu {

double ElevationVariance(const HarmonicSpectrum& spectrum);  // m^2, the integral of S dk

// 4 sqrt(m0) [m]. Stations may state the mean of the highest third of waves instead, which is some 5 % less.
double SignificantWaveHeight(const HarmonicSpectrum& spectrum);

double MeanSquareSlope(const HarmonicSpectrum& spectrum);  // the integral of k^2 S dk

// The same for waves with wavenumbers below `k` [rad/m].
double MeanSquareSlopeBelow(const HarmonicSpectrum& spectrum, double k);

}  // namespace albtpu
