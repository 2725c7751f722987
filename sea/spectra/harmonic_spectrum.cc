#include "sea/spectra/harmonic_spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

constexpr double kLowest = 0.004, kHighest = 3500;  // rad/m
constexpr double kRatio = 1.05;

// Directions over which a spreading is averaged. The trapezoidal rule over a full turn is exact for a spreading whose
// harmonics end below kDirectionsOfEach - 2 * harmonics. A spreading that is the same at all k is averaged only once,
// so it gets more: cosine-2S spreadings whose s is not an integer have harmonics without end, which decay as
// n^(-2 s - 1).
constexpr std::size_t kDirectionsOfEach = 32, kDirectionsOfOne = 4096;

struct Harmonics {
  std::vector<double> a, b;
};

// The cosines of whole multiples of a fraction of a turn.
std::vector<double> CosinesOfTurn(std::size_t fractions) {
  std::vector<double> cosines(fractions);
  for (std::size_t i = 0; i < fractions; ++i)
    cosines[i] = std::cos(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(fractions));
  return cosines;
}

Harmonics HarmonicsAt(const WaveSpectrum& spectrum, double k, std::size_t count, const std::vector<double>& cosines) {
  const std::size_t directions = cosines.size();
  assert(2 * count < directions / 2);
  Harmonics sums{std::vector<double>(count), std::vector<double>(count)};
  double energy = 0;
  for (std::size_t i = 0; i < directions; ++i) {
    const double psi = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(directions);
    const double spreading = spectrum.Spreading(k, psi);
    energy += spreading;
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t angle = 2 * (n + 1) * i;
      sums.a[n] += spreading * cosines[angle % directions];
      sums.b[n] += spreading * cosines[(angle + 3 * directions / 4) % directions];  // the sine
    }
  }
  for (std::size_t n = 0; n < count; ++n) {
    sums.a[n] /= energy;
    sums.b[n] /= energy;
  }
  return sums;
}

}  // namespace

std::vector<double> SeaWavenumbers() {
  const double range = std::log(kHighest / kLowest);
  const auto steps = static_cast<std::size_t>(std::ceil(range / std::log(kRatio)));
  std::vector<double> k(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i)
    k[i] = kLowest * std::exp(range * static_cast<double>(i) / static_cast<double>(steps));
  k.back() = kHighest;
  return k;
}

HarmonicSpectrum Sampled(const WaveSpectrum& spectrum, const std::vector<double>& wavenumbers, std::size_t harmonics) {
  HarmonicSpectrum sampled;
  sampled.k = wavenumbers;
  sampled.a.assign(harmonics, std::vector<double>(wavenumbers.size()));
  sampled.b = sampled.a;
  const bool varies = spectrum.spreading_varies_with_wavenumber();
  const std::vector<double> cosines = CosinesOfTurn(varies ? kDirectionsOfEach : kDirectionsOfOne);
  Harmonics at_k;
  for (std::size_t i = 0; i < wavenumbers.size(); ++i) {
    const double k = wavenumbers[i];
    assert(k > 0 && (i == 0 || k > wavenumbers[i - 1]));
    sampled.s.push_back(spectrum(k));
    if (varies || i == 0) at_k = HarmonicsAt(spectrum, k, harmonics, cosines);
    for (std::size_t n = 0; n < harmonics; ++n) {
      sampled.a[n][i] = at_k.a[n];
      sampled.b[n][i] = at_k.b[n];
    }
  }
  return sampled;
}

HarmonicSpectrum FlatSea(const std::vector<double>& wavenumbers, std::size_t harmonics) {
  const std::vector<double> zeros(wavenumbers.size());
  return {wavenumbers, zeros, {harmonics, zeros}, {harmonics, zeros}};
}

HarmonicSpectrum Resampled(const HarmonicSpectrum& spectrum, const std::vector<double>& wavenumbers) {
  HarmonicSpectrum resampled = FlatSea(wavenumbers, spectrum.harmonics());
  for (std::size_t i = 0; i < wavenumbers.size(); ++i) {
    const double k = wavenumbers[i];
    if (spectrum.k.empty() || k < spectrum.k.front() || k > spectrum.k.back()) continue;
    const auto above = std::lower_bound(spectrum.k.begin(), spectrum.k.end(), k);
    const auto right = static_cast<std::size_t>(above - spectrum.k.begin());
    const std::size_t left = right == 0 ? 0 : right - 1;
    const double t = right == left ? 0 : (k - spectrum.k[left]) / (spectrum.k[right] - spectrum.k[left]);
    const double s_left = (1 - t) * spectrum.s[left], s_right = t * spectrum.s[right];
    resampled.s[i] = s_left + s_right;
    if (!(resampled.s[i] > 0)) continue;
    for (std::size_t n = 0; n < spectrum.harmonics(); ++n) {
      resampled.a[n][i] = (s_left * spectrum.a[n][left] + s_right * spectrum.a[n][right]) / resampled.s[i];
      resampled.b[n][i] = (s_left * spectrum.b[n][left] + s_right * spectrum.b[n][right]) / resampled.s[i];
    }
  }
  return resampled;
}

HarmonicSpectrum Rotated(HarmonicSpectrum spectrum, double angle) {
  for (std::size_t n = 0; n < spectrum.harmonics(); ++n) {
    const double cosine = std::cos(2 * static_cast<double>(n + 1) * angle);
    const double sine = std::sin(2 * static_cast<double>(n + 1) * angle);
    for (std::size_t i = 0; i < spectrum.size(); ++i) {
      const double a = spectrum.a[n][i], b = spectrum.b[n][i];
      spectrum.a[n][i] = a * cosine - b * sine;
      spectrum.b[n][i] = a * sine + b * cosine;
    }
  }
  return spectrum;
}

HarmonicSpectrum WeightedSum(const HarmonicSpectrum& a, double weight_a, const HarmonicSpectrum& b, double weight_b) {
  assert(a.k == b.k && weight_a >= 0 && weight_b >= 0);
  HarmonicSpectrum sum = FlatSea(a.k, std::max(a.harmonics(), b.harmonics()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double s_a = weight_a * a.s[i], s_b = weight_b * b.s[i];
    sum.s[i] = s_a + s_b;
    if (!(sum.s[i] > 0)) continue;
    for (std::size_t n = 0; n < sum.harmonics(); ++n) {
      const auto mean = [&](const auto& of_a, const auto& of_b) {
        return ((n < of_a.size() ? s_a * of_a[n][i] : 0) + (n < of_b.size() ? s_b * of_b[n][i] : 0)) / sum.s[i];
      };
      sum.a[n][i] = mean(a.a, b.a);
      sum.b[n][i] = mean(a.b, b.b);
    }
  }
  return sum;
}

}  // namespace albtpu
