#include "sea/spectra/spectrum_moments.h"

#include <cmath>
#include <limits>

namespace albtpu {
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
