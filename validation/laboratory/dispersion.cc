#include "validation/laboratory/dispersion.h"

#include <cassert>
#include <cmath>

#include "sea/spectra/wave_spectrum.h"

namespace albtpu {
namespace {

constexpr double kTensionOverDensity = kSurfaceTension / kWaterDensity;  // m^3/s^2

}  // namespace

double AngularFrequency(double k) {
  assert(k >= 0);
  return std::sqrt(kGravity * k + kTensionOverDensity * k * k * k);
}

// The one real root of k^3 + p k = q, by hyperbolic functions.
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

}  // namespace albtpu
