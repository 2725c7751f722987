// A directional elevation spectrum in samples of wavenumber: the common form of all seas, whether measured, computed by
// a model, described by a few numbers, or raised by a wind.
#pragma once

#include <cstddef>
#include <vector>

#include "sea/spectra/wave_spectrum.h"

namespace albtpu {

// S(k) [m^3] and the even harmonics of the spreading at wavenumbers k [rad/m] that increase. With psi from the x axis,
//     Psi(k, psi) k = S(k) / (2 pi) * (1 + 2 sum over n >= 1 of (a_n cos(2 n psi) + b_n sin(2 n psi))),
// where a_n and b_n are the means of cos(2 n psi) and sin(2 n psi) over the energy at k. A frozen surface has even
// harmonics only: a wave and the one that travels the opposite way look alike.
//
// x is where the wind blows to (calm: where the first component travels), y 90 degrees to its left seen from above.
// Between samples S, S a_n and S b_n are interpolated linearly in k; beyond the first and the last they are 0. The
// variance is the sum by trapezoids.
struct HarmonicSpectrum {
  std::vector<double> k;  // rad/m
  std::vector<double> s;  // m^3
  // [n - 1][i]: harmonic 2 n at k[i]. As many as matter; at least one.
  std::vector<std::vector<double>> a, b;

  std::size_t size() const { return k.size(); }
  std::size_t harmonics() const { return a.size(); }

  bool operator==(const HarmonicSpectrum&) const = default;
};

// Harmonics 2 to 12: as many as a described or measured sea is given.
inline constexpr std::size_t kSeaHarmonics = 6;

// The wavenumbers at which seas are sampled: 0.004 to 3500 rad/m in steps of 5 %, from the longest swell (32 s in deep
// water) to the shortest capillary waves that still have slope.
std::vector<double> SeaWavenumbers();

// The samples of a spectrum of the wind sea, with `harmonics` harmonics.
HarmonicSpectrum Sampled(const WaveSpectrum& spectrum, const std::vector<double>& wavenumbers, std::size_t harmonics);

// A sea without waves.
HarmonicSpectrum FlatSea(const std::vector<double>& wavenumbers, std::size_t harmonics);

// Interpolates at other wavenumbers.
HarmonicSpectrum Resampled(const HarmonicSpectrum& spectrum, const std::vector<double>& wavenumbers);

// The same sea with every direction psi increased by `angle` [rad].
HarmonicSpectrum Rotated(HarmonicSpectrum spectrum, double angle);

// weight_a * a + weight_b * b: the sum of independent waves (1, 1), or a state between two times (1 - t, t). Both have
// the same wavenumbers; missing harmonics count as 0. Weights are not negative.
HarmonicSpectrum WeightedSum(const HarmonicSpectrum& a, double weight_a, const HarmonicSpectrum& b, double weight_b);

}  // namespace albtpu
