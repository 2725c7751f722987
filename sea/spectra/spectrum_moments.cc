#include "sea/spectra/spectrum_moments.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "sea/spectra/wave_spectrum.h"

namespace albtpu {
double WavenumberOfFrequency(double f, double depth) {
  assert(f > 0 && depth > 0);
  const double omega = 2 * std::numbers::pi * f;
  const double deep = omega * omega / kGravity;
  const double y = deep * depth;
  if (y > 20) return deep;  // tanh(20) is 1 in double precision
  // x tanh(x) = y by Newton's method from Eckart's approximation, which is right at both limits and within 5 % between.
  double x = y / std::sqrt(std::tanh(y));
  for (int i = 0; i < 20; ++i) {
    const double tanh = std::tanh(x);
    const double change = (x * tanh - y) / (tanh + x * (1 - tanh * tanh));
    x -= change;
    if (std::abs(change) <= 1e-15 * x) break;
  }
  return x / depth;
}

double FrequencyOfWavenumber(double k, double depth) {
  assert(k > 0 && depth > 0);
  return std::sqrt(kGravity * k * std::tanh(k * depth)) / (2 * std::numbers::pi);
}

double FrequencySlope(double k, double depth) {
  return 0.5 * FrequencyOfWavenumber(k, depth) / k * (1 + Shallowness(k, depth));
}

double Shallowness(double k, double depth) {
  const double x = 2 * k * depth;
  return x > 700 ? 0 : x / std::sinh(x);  // sinh(711) overflows
}

double AngularFrequency(double k, double depth) {
  assert(k >= 0 && depth > 0);
  const double squared = kGravity * k + kSurfaceTension / kWaterDensity * k * k * k;
  return std::sqrt(std::isinf(depth) ? squared : squared * std::tanh(k * depth));
}

namespace {

// The integral of k^power S from the first sample to `end`, linear in the interval that `end` divides.
double Moment(const HarmonicSpectrum& spectrum, int power, double end) {
  double sum = 0;
  for (std::size_t i = 1; i < spectrum.size() && spectrum.k[i - 1] < end; ++i) {
    const double from = spectrum.k[i - 1], to = spectrum.k[i];
    const double first = std::pow(from, power) * spectrum.s[i - 1];
    const double last = std::pow(to, power) * spectrum.s[i];
    const double part = end < to ? (end - from) / (to - from) : 1;
    sum += (to - from) * part * (first + 0.5 * part * (last - first));
  }
  return sum;
}

constexpr double kAll = std::numeric_limits<double>::infinity();

}  // namespace

double ElevationVariance(const HarmonicSpectrum& spectrum) { return Moment(spectrum, 0, kAll); }

double SignificantWaveHeight(const HarmonicSpectrum& spectrum) { return 4 * std::sqrt(ElevationVariance(spectrum)); }

double MeanSquareSlope(const HarmonicSpectrum& spectrum) { return Moment(spectrum, 2, kAll); }

double MeanSquareSlopeBelow(const HarmonicSpectrum& spectrum, double k) { return Moment(spectrum, 2, k); }

}  // namespace albtpu
