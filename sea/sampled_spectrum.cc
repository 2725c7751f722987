#include "sea/sampled_spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace albtpu {
namespace {

// The range of samples outside of which lies at most half of 1e-4 of the elevation variance and of the slope variance
// on either side; all of them for a sea without waves.
WavenumberRange EnergeticRange(const std::vector<double>& k, const std::vector<double>& s) {
  constexpr double kLeftOut = 0.5e-4;
  std::vector<double> elevation(k.size()), slope(k.size());  // of all waves up to each sample
  for (std::size_t i = 1; i < k.size(); ++i) {
    const double below = 0.5 * (k[i] - k[i - 1]) * s[i - 1], above = 0.5 * (k[i] - k[i - 1]) * s[i];
    elevation[i] = elevation[i - 1] + below + above;
    slope[i] = slope[i - 1] + below * k[i - 1] * k[i - 1] + above * k[i] * k[i];
  }
  std::size_t first = 0, last = k.size() - 1;
  while (first + 1 < last && elevation[first + 1] < kLeftOut * elevation.back() &&
         slope[first + 1] < kLeftOut * slope.back()) {
    ++first;
  }
  while (last > first + 1 && elevation[last - 1] > (1 - kLeftOut) * elevation.back() &&
         slope[last - 1] > (1 - kLeftOut) * slope.back()) {
    --last;
  }
  return {k[first], k[last]};
}

}  // namespace

SampledSpectrum::SampledSpectrum(const HarmonicSpectrum& spectrum, SpectrumText text)
    : range_(EnergeticRange(spectrum.k, spectrum.s)), text_(std::move(text)) {
  assert(spectrum.size() >= 2);
  std::vector<double> a(spectrum.harmonics()), b(spectrum.harmonics());
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    log_k_.push_back(std::log(spectrum.k[i]));
    saturation_.push_back(std::pow(spectrum.k[i], 3) * spectrum.s[i]);
    for (std::size_t n = 0; n < a.size(); ++n) {
      a[n] = spectrum.s[i] > 0 ? spectrum.a[n][i] : 0;
      b[n] = spectrum.s[i] > 0 ? spectrum.b[n][i] : 0;
    }
    spreading_.emplace_back(a, b);
  }
}

SampledSpectrum::Between SampledSpectrum::Find(double k) const {
  const double log_k = std::log(k);
  if (log_k < log_k_.front() || log_k > log_k_.back()) return {0, 0, 0};
  const auto above = std::upper_bound(log_k_.begin() + 1, log_k_.end() - 1, log_k);
  const auto at = static_cast<std::size_t>(above - log_k_.begin()) - 1;
  const double t = (log_k - log_k_[at]) / (log_k_[at + 1] - log_k_[at]);
  return {at, (1 - t) * saturation_[at], t * saturation_[at + 1]};
}

double SampledSpectrum::operator()(double k) const {
  const Between here = Find(k);
  return (here.first + here.second) / (k * k * k);
}

double SampledSpectrum::Spreading(double k, double psi) const {
  const auto [at, first, second] = Find(k);
  if (!(first + second > 0)) return 1 / (2 * std::numbers::pi);
  return (first * spreading_[at](psi) + second * spreading_[at + 1](psi)) / (first + second);
}

double SampledSpectrum::peak_wavenumber() const {
  const auto energy = [&](std::size_t i) { return saturation_[i] * std::exp(-2 * log_k_[i]); };  // k S(k)
  std::size_t peak = 0;
  for (std::size_t i = 1; i < log_k_.size(); ++i) {
    if (energy(i) > energy(peak)) peak = i;
  }
  return std::exp(log_k_[peak]);
}

}  // namespace albtpu
