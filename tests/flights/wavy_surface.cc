#include "tests/flights/wavy_surface.h"

#include <cmath>
#include <numbers>

namespace albtpu::testing {

WavySurface::WavySurface(double height, double towards, RandomNumbers& random) {
  if (height == 0) return;
  constexpr int kWaves = 48;
  constexpr double kPeak = 10, kLongest = 20, kShortest = 1;  // m
  constexpr double kStandardGravity = 9.80665;                // m/s^2, exact (CGPM 1901).
  // Wavenumbers in equal steps of ln k, each with the variance k^-3 k d(ln k) exp(-1.25 (k_p / k)^2).
  double variance = 0;
  for (int i = 0; i < kWaves; ++i) {
    const double fraction = (i + random.Uniform(0, 1)) / kWaves;
    const double length = kLongest * std::pow(kShortest / kLongest, fraction);
    const double k = 2 * std::numbers::pi / length;
    const double share = std::exp(-1.25 * length * length / (kPeak * kPeak)) / (k * k);
    const double direction = towards + random.Uniform(-1, 1) * std::numbers::pi / 3;
    variance += share;
    waves_.push_back({std::sqrt(2 * share),
                      {k * std::sin(direction), k * std::cos(direction)},
                      std::sqrt(kStandardGravity * k),
                      random.Uniform(0, 2 * std::numbers::pi)});
  }
  // Hs is four standard deviations.
  const double factor = height / 4 / std::sqrt(variance);
  for (Wave& wave : waves_) wave.amplitude *= factor;
}

WavySurface::Local WavySurface::At(const Eigen::Vector2d& east_north, double time) const {
  Local local;
  for (const Wave& wave : waves_) {
    const double phase = wave.wavenumber.dot(east_north) - wave.frequency * time + wave.phase;
    local.elevation += wave.amplitude * std::sin(phase);
    local.slope += wave.amplitude * std::cos(phase) * wave.wavenumber;
  }
  return local;
}

}  // namespace albtpu::testing
