// Seas and beams on which tests try the response theory.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

#include "sea/sea_state.h"
#include "sea/spectra/harmonic_spectrum.h"

namespace albtpu {

inline constexpr BeamProfile kProfiles[] = {BeamProfile::kUniform, BeamProfile::kGaussian};

inline HarmonicSpectrum WindSeaOf(double wind_speed_10m, const SpectrumModel& model = kElfouhailyModel,
                                  double slope_scale = 1) {
  HarmonicSpectrum sea =
      Sampled(*WindSea{.wind_speed_10m = wind_speed_10m, .model = &model}.MakeSpectrum(), SeaWavenumbers(), 1);
  for (double& s : sea.s) s *= slope_scale * slope_scale;
  return sea;
}

// A swell of the height variance `variance` [m^2], normal in ln k about `peak` [rad/m] with the deviation 0.3, whose
// harmonics 2 and 4 are those of waves that travel along the axis at `axis` [rad] with the given means.
inline HarmonicSpectrum Swell(double variance, double peak, double axis, double second, double fourth) {
  constexpr double kWidth = 0.3;
  HarmonicSpectrum sea{SeaWavenumbers(), {}, {{}, {}}, {{}, {}}};
  for (const double k : sea.k) {
    const double x = std::log(k / peak) / kWidth;
    sea.s.push_back(variance * std::exp(-x * x / 2) / (k * kWidth * std::sqrt(2 * std::numbers::pi)));
    sea.a[0].push_back(second * std::cos(2 * axis));
    sea.b[0].push_back(second * std::sin(2 * axis));
    sea.a[1].push_back(fourth * std::cos(4 * axis));
    sea.b[1].push_back(fourth * std::sin(4 * axis));
  }
  return sea;
}

inline HarmonicSpectrum CrossingSea() { return WeightedSum(WindSeaOf(7), 1, Swell(0.03, 0.4, 1.0, 0.8, 0.5), 1); }

// Few waves of a lattice, whose twin is a sum over all of them.
inline HarmonicSpectrum LongSea() {
  return WeightedSum(Swell(2e-3, 1.5, 1.0, 0.6, 0.3), 1, Swell(1e-3, 0.6, -0.3, 0.8, 0.5), 1);
}

// The sea in a mirror along the x axis.
inline HarmonicSpectrum Mirrored(HarmonicSpectrum sea) {
  for (std::vector<double>& b : sea.b)
    for (double& value : b) value = -value;
  return sea;
}

// The slow twin of all integrals: calls wave(Psi d^2k, k) for the waves of a fine grid over the whole plane.
template <typename Wave>
void ForEachWave(const HarmonicSpectrum& sea, int directions, const Wave& wave) {
  for (std::size_t i = 0; i < sea.size(); ++i) {
    if (sea.s[i] == 0) continue;
    const double dk = sea.k[i] * std::log(sea.k.back() / sea.k.front()) / (sea.size() - 1.0);
    for (int j = 0; j < directions; ++j) {
      const double psi = 2 * std::numbers::pi * (j + 0.5) / directions;
      double density = 1;
      for (std::size_t n = 0; n < sea.harmonics(); ++n)
        density += 2 * (sea.a[n][i] * std::cos(2 * (n + 1) * psi) + sea.b[n][i] * std::sin(2 * (n + 1) * psi));
      wave(sea.s[i] * dk * density / directions, Eigen::Vector2d(sea.k[i] * std::cos(psi), sea.k[i] * std::sin(psi)));
    }
  }
}

}  // namespace albtpu
