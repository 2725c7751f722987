#include "sea/spectra/jonswap.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "sea/spectra/spectrum_moments.h"
#include "sea/spectra/wave_spectrum.h"
#include "sea/spectra/wave_spreading.h"

namespace albtpu {
namespace {

// Kitaigorodskii's factor: 1 in deep water.
double DepthFactor(double f, double depth) {
  if (std::isinf(depth)) return 1;
  const double k = WavenumberOfFrequency(f, depth);
  const double tanh = std::tanh(k * depth);
  return tanh * tanh / (1 + Shallowness(k, depth));
}

// The spectrum before it is scaled, for x = f / fp: dimensionless.
double Shape(double x, double gamma) {
  const double sigma = x <= 1 ? 0.07 : 0.09;
  const double from_peak = (x - 1) / sigma;
  return std::pow(x, -5) * std::exp(-1.25 * std::pow(x, -4)) * std::pow(gamma, std::exp(-0.5 * from_peak * from_peak));
}

// The integral of Shape(x) DepthFactor(x fp) dx over all x by the trapezoidal rule in log x, with a node at the peak,
// where sigma jumps. Below x = 0.3 the shape is under e^-154. Above the last node the factor of depth is 1 and the
// integral of x^-5 exp(-1.25 x^-4) is (1 - exp(-1.25 x^-4)) / 5.
double IntegralOfShape(const JonswapWaves& waves, double depth) {
  constexpr double kStep = 0.01;
  const double fp = 1 / waves.peak_period;
  const double deep_from = std::sqrt(20 * kGravity / depth) / (2 * std::numbers::pi * fp);  // there k h is 20
  const int first = static_cast<int>(std::floor(std::log(0.3) / kStep));
  const int last = static_cast<int>(std::ceil(std::log(std::clamp(deep_from, 30.0, 1e6)) / kStep));
  double sum = 0;
  for (int i = first; i <= last; ++i) {
    const double x = std::exp(i * kStep);
    sum += (i == last ? 0.5 : 1.0) * kStep * x * Shape(x, waves.gamma) * DepthFactor(x * fp, depth);
  }
  return sum - std::expm1(-1.25 * std::exp(-4 * last * kStep)) / 5;
}

const JonswapWaves& OfShortestPeriod(const std::vector<JonswapWaves>& waves) {
  return *std::min_element(waves.begin(), waves.end(),
                           [](const JonswapWaves& a, const JonswapWaves& b) { return a.peak_period < b.peak_period; });
}

}  // namespace

JonswapSpectrum::JonswapSpectrum(std::vector<JonswapWaves> waves, double depth)
    : waves_(std::move(waves)), depth_(depth) {
  assert(!waves_.empty() && depth > 0);
  for (const JonswapWaves& each : waves_) {
    assert(each.significant_wave_height >= 0 && each.peak_period > 0 && each.gamma >= 1);
    const double variance = std::pow(each.significant_wave_height / 4, 2);
    scales_.push_back(variance * each.peak_period / IntegralOfShape(each, depth));
  }
}

DirectionalEnergy JonswapSpectrum::operator()(double f) const {
  const double depth_factor = DepthFactor(f, depth_);
  DirectionalEnergy sum;
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    const JonswapWaves& waves = waves_[i];
    const double x = f * waves.peak_period;
    const double s = waves.spread ? Cosine2sOfSpread(*waves.spread) : MitsuyasuS(x);
    sum.Add(SymmetricEnergy(scales_[i] * Shape(x, waves.gamma) * depth_factor, Cosine2sHarmonics(s),
                            waves.travels_towards));
  }
  return sum;
}

std::vector<double> JonswapSpectrum::ComparedFrequencies(double lowest, double highest) const {
  constexpr int kCompared = 100;
  std::vector<double> compared(kCompared);
  for (int i = 0; i < kCompared; ++i)
    compared[i] = lowest * std::pow(highest / lowest, static_cast<double>(i) / (kCompared - 1));
  return compared;
}

double JonswapSpectrum::trusted_up_to() const { return std::max(0.4, 2.5 / OfShortestPeriod(waves_).peak_period); }

double JonswapSpectrum::significant_wave_height() const {
  double squares = 0;
  for (const JonswapWaves& each : waves_) squares += std::pow(each.significant_wave_height, 2);
  return std::sqrt(squares);
}

double JonswapSpectrum::leading_axis() const { return waves_.front().travels_towards; }

std::optional<double> JonswapSpectrum::shortest_peak() const { return 1 / OfShortestPeriod(waves_).peak_period; }

std::optional<double> JonswapSpectrum::ShortWaveAxis(double) const {
  const JonswapWaves& shortest = OfShortestPeriod(waves_);
  const double s = shortest.spread ? Cosine2sOfSpread(*shortest.spread) : MitsuyasuS(1);
  if (SymmetricEnergy(1, Cosine2sHarmonics(s), 0).IsIsotropic()) return std::nullopt;
  return shortest.travels_towards;
}

}  // namespace albtpu
