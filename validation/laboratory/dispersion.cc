#include "validation/laboratory/dispersion.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "sea/spectra/wave_spectrum.h"

namespace albtpu {
namespace {

constexpr double kTensionOverDensity = kSurfaceTension / kWaterDensity;  // m^3/s^2

}  // namespace

double AngularFrequency(double k) {
  assert(k >= 0);
  return std::sqrt(kGravity * k + kTensionOverDensity * k * k * k);
}

// The only real root of k^3 + p k = q, by hyperbolic functions.
double Wavenumber(double omega) {
  assert(omega >= 0);
  const double p = kGravity / kTensionOverDensity;
  const double q = omega * omega / kTensionOverDensity;
  const double scale = 2 * std::sqrt(p / 3);
  return scale * std::sinh(std::asinh(3 * q / (p * scale)) / 3);
}

double GroupSpeed(double k) {
  assert(k > 0);
  return (kGravity + 3 * kTensionOverDensity * k * k) / (2 * AngularFrequency(k));
}

double FrequencySpectrum(const SeaState& sea, double frequency) {
  const double k = Wavenumber(2 * std::numbers::pi * frequency);
  return 2 * std::numbers::pi * sea.S(k) / GroupSpeed(k);
}

double PeakFrequency(const SeaState& sea) {
  constexpr double kStep = 1e-4;  // of the logarithm of the frequency
  const auto [lowest, highest] = sea.energetic_range();
  const double first = AngularFrequency(lowest) / (2 * std::numbers::pi);
  const double last = AngularFrequency(highest) / (2 * std::numbers::pi);
  double peak = first, height = 0;
  for (double f = first; f <= last; f *= 1 + kStep) {
    const double here = FrequencySpectrum(sea, f);
    if (here > height) {
      peak = f;
      height = here;
    }
  }
  return peak;
}

}  // namespace albtpu
