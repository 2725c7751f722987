#include "validation/laboratory/wave_staff.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <numeric>
#include <unsupported/Eigen/FFT>

#include "sea/spectra/wave_spectrum.h"

namespace albtpu {
namespace {

constexpr double kTensionOverDensity = kSurfaceTension / kWaterDensity;  // m^3/s^2

}  // namespace

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

namespace {

double MeanOf(const double* first, std::size_t count) {
  return std::accumulate(first, first + count, 0.0) / static_cast<double>(count);
}

}  // namespace

WaveStaff::WaveStaff(const SeaState& sea, int samples, double rate)
    : samples_(samples), power_(2 * static_cast<std::size_t>(samples), 0.0) {
  assert(samples > 0 && rate > 0);
  const double df = rate / static_cast<double>(power_.size());
  const double highest = AngularFrequency(sea.energetic_range().highest) / (2 * std::numbers::pi);
  for (std::size_t m = 1; static_cast<double>(m) * df <= highest; ++m)
    power_[m % power_.size()] += FrequencySpectrum(sea, static_cast<double>(m) * df) * df;
}

std::vector<double> WaveStaff::Draw(NormalStream stream) const {
  std::vector<double> normals(2 * power_.size());
  stream.Fill(normals);
  std::vector<std::complex<double>> turning(power_.size());
  for (std::size_t m = 0; m < power_.size(); ++m)
    turning[m] = std::sqrt(power_[m]) * std::complex<double>(normals[2 * m], normals[2 * m + 1]);
  std::vector<std::complex<double>> elevation;
  Eigen::FFT<double> fft(Eigen::default_fft_impl<double>(), Eigen::FFT<double>::Unscaled);
  fft.inv(elevation, turning);
  std::vector<double> record(samples_);
  for (int n = 0; n < samples_; ++n) record[n] = elevation[n].real();
  return record;
}

double RecordSpectrum::PeakFrequency() const {
  return resolution * static_cast<double>(std::max_element(density.begin(), density.end()) - density.begin());
}

double RecordSpectrum::SignificantWaveHeight() const {
  return 4 * std::sqrt(resolution * std::accumulate(density.begin(), density.end(), 0.0));
}

RecordSpectrum WelchSpectrum(const std::vector<double>& record, double rate, int segment) {
  assert(segment >= 2 && record.size() >= static_cast<std::size_t>(segment));
  std::vector<double> window(segment);
  for (int n = 0; n < segment; ++n) window[n] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * n / segment);
  const double window_power = std::inner_product(window.begin(), window.end(), window.begin(), 0.0);

  RecordSpectrum spectrum{rate / segment, std::vector<double>(segment / 2 + 1, 0.0)};
  Eigen::FFT<double> fft;
  std::vector<double> piece(segment);
  std::vector<std::complex<double>> modes;
  int segments = 0;
  for (std::size_t first = 0; first + segment <= record.size(); first += segment / 2, ++segments) {
    const double mean = MeanOf(&record[first], segment);
    for (int n = 0; n < segment; ++n) piece[n] = window[n] * (record[first + n] - mean);
    fft.fwd(modes, piece);
    for (int m = 0; m <= segment / 2; ++m) {
      const double sides = m == 0 || m == segment / 2 ? 1 : 2;
      spectrum.density[m] += sides * std::norm(modes[m]) / (rate * window_power);
    }
  }
  for (double& density : spectrum.density) density /= segments;
  return spectrum;
}

double HighestThird(const std::vector<double>& record) {
  const double mean = MeanOf(record.data(), record.size());
  std::vector<double> heights;
  bool in_a_wave = false;
  double crest = 0, trough = 0;
  for (std::size_t n = 1; n < record.size(); ++n) {
    if (record[n - 1] < mean && record[n] >= mean) {
      if (in_a_wave) heights.push_back(crest - trough);
      in_a_wave = true;
      crest = trough = mean;
    }
    crest = std::max(crest, record[n]);
    trough = std::min(trough, record[n]);
  }
  assert(heights.size() >= 3);
  std::sort(heights.begin(), heights.end(), std::greater<>());
  return MeanOf(heights.data(), heights.size() / 3);
}

}  // namespace albtpu
