// A spectrum of samples as waves that tracing can draw.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "sea/spectra/harmonic_spectrum.h"
#include "sea/wave_state.h"

namespace albtpu {

// Between samples k^3 S is interpolated in ln k: the slope variance is then the sum over the samples from which the
// response theory computes. A few harmonics of a narrow spreading add up to less than 0 in some directions, where there
// are no waves.
class SampledWaves final : public WaveSpectrum {
 public:
  explicit SampledWaves(HarmonicSpectrum spectrum) : spectrum_(std::move(spectrum)) {
    for (std::size_t i = 0; i < spectrum_.size(); ++i) {
      constexpr int kDirections = 128;  // of half a turn
      double sum = 0;
      for (int j = 0; j < kDirections; ++j) sum += Clipped(i, std::numbers::pi * j / kDirections);
      normalization_.push_back(2 * std::numbers::pi * sum / kDirections);
    }
  }

  double operator()(double k) const override {
    const auto [i, t] = Place(k);
    return i < 0 ? 0 : ((1 - t) * Variance(i, 2) + t * Variance(i + 1, 2)) / (k * k * k);
  }
  double Spreading(double k, double psi) const override {
    const auto [i, t] = Place(k);
    if (i < 0) return 0.5 / std::numbers::pi;
    const double before = (1 - t) * Variance(i, 2), after = t * Variance(i + 1, 2);
    if (before + after == 0) return 0.5 / std::numbers::pi;
    return (before * Clipped(i, psi) / normalization_[i] +
            after * Clipped(i + 1, psi) / normalization_[i + 1]) /
           (before + after);
  }
  bool spreading_varies_with_wavenumber() const override { return true; }

  double peak_wavenumber() const override {
    return spectrum_.k[std::max_element(spectrum_.s.begin(), spectrum_.s.end()) - spectrum_.s.begin()];
  }
  WavenumberRange energetic_range() const override {
    const auto variance_beyond = [&](int power, bool above) {
      double sum = 0, all = 0;
      for (std::size_t i = 0; i < spectrum_.size(); ++i) all += Variance(i, power);
      for (std::size_t n = 0; n < spectrum_.size(); ++n) {
        const std::size_t i = above ? spectrum_.size() - 1 - n : n;
        if ((sum += Variance(i, power)) > 5e-5 * all) return spectrum_.k[i];
      }
      return spectrum_.k[0];
    };
    return {variance_beyond(0, false), variance_beyond(2, true)};
  }
  std::string name() const override { return "samples"; }
  std::string reference() const override { return "none"; }
  std::string departures() const override { return "none"; }

 private:
  // The sample before k and the fraction of the way to the next in ln k; -1 outside.
  std::pair<int, double> Place(double k) const {
    const std::vector<double>& nodes = spectrum_.k;
    const auto next = std::upper_bound(nodes.begin(), nodes.end(), k);
    if (next == nodes.begin() || next == nodes.end()) return {-1, 0};
    return {static_cast<int>(next - nodes.begin()) - 1,
            std::log(k / next[-1]) / std::log(next[0] / next[-1])};
  }

  double Clipped(std::size_t i, double psi) const {
    const std::complex<double> turn = std::polar(1.0, 2 * psi);
    std::complex<double> turns = 1;
    double sum = 1;
    for (std::size_t n = 0; n < spectrum_.harmonics(); ++n) {
      turns *= turn;
      sum += 2 * (spectrum_.a[n][i] * turns.real() + spectrum_.b[n][i] * turns.imag());
    }
    return std::max(0.0, sum);
  }

  // Of the sample's share of k^power S in steps of ln k.
  double Variance(std::size_t i, int power) const {
    return spectrum_.s[i] * std::pow(spectrum_.k[i], power + 1);
  }

  HarmonicSpectrum spectrum_;
  std::vector<double> normalization_;
};

// The sea that `make` makes, as a model of the wind sea whose wind and fetch say nothing.
template <HarmonicSpectrum (*make)()>
inline const SpectrumModel kSampled = {
    "sampled", "none", false, [](double) { return std::numeric_limits<double>::infinity(); },
    [](double, double, const Cosine2sSpreading&) -> std::shared_ptr<const WaveSpectrum> {
      return std::make_shared<SampledWaves>(make());
    }};

}  // namespace albtpu
