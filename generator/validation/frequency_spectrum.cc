#include "generator/validation/frequency_spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "generator/validation/dispersion.h"

namespace albtpu {

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

std::vector<double> StaffRecord(const SeaState& sea, int samples, double rate, NormalStream stream) {
  assert(samples > 0 && rate > 0);
  const std::size_t period = 2 * static_cast<std::size_t>(samples);
  const double df = rate / static_cast<double>(period);
  const double highest = AngularFrequency(sea.energetic_range().highest) / (2 * std::numbers::pi);
  const std::size_t waves = static_cast<std::size_t>(highest / df);
  std::vector<double> normals(2 * waves);
  stream.Fill(normals);

  // At the sampled instants a wave of m turns in the period is one of m modulo `period`.
  std::vector<std::complex<double>> turning(period, 0.0);
  for (std::size_t m = 1; m <= waves; ++m) {
    const double amplitude = std::sqrt(FrequencySpectrum(sea, static_cast<double>(m) * df) * df);
    turning[m % period] += amplitude * std::complex<double>(normals[2 * m - 2], normals[2 * m - 1]);
  }
  std::vector<std::complex<double>> elevation;
  Eigen::FFT<double> fft(Eigen::default_fft_impl<double>(), Eigen::FFT<double>::Unscaled);
  fft.inv(elevation, turning);
  std::vector<double> record(samples);
  std::transform(elevation.begin(), elevation.begin() + samples, record.begin(),
                 [](const std::complex<double>& z) { return z.real(); });
  return record;
}

}  // namespace albtpu
