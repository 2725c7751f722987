#include "sea/spectra/equilibrium_wind.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "sea/spectra/wind_sea.h"

namespace albtpu {
namespace {

// The x at which a function that increases from f(0) <= y reaches `y`, by bisection to the last bit.
template <typename Function>
double Inverse(const Function& f, double y) {
  double low = 0, high = 1;
  while (f(high) < y) high *= 2;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (f(middle) < y ? low : high) = middle;
  }
  return high;
}

}  // namespace

std::optional<double> EquilibriumFrictionVelocity(const FrequencySpectrum& spectrum) {
  constexpr double kLowest = 0.2, kHighest = 0.4;  // Hz
  constexpr double kBeta = 0.012, kDirectionalIntegral = 2.5;
  if (spectrum.highest_frequency() < kLowest) return std::nullopt;
  double sum = 0;
  constexpr int kFrequencies = 100;
  int counted = 0;
  for (int i = 0; i <= kFrequencies; ++i) {
    const double f = kLowest + (kHighest - kLowest) * i / kFrequencies;
    if (f > spectrum.highest_frequency()) break;
    sum += spectrum(f).energy * std::pow(f, 4);
    ++counted;
  }
  return 2 * std::pow(std::numbers::pi, 3) * sum / counted / (kBeta * kDirectionalIntegral * kGravity);
}

double WindSpeedOfFrictionVelocity(double friction_velocity) {
  assert(friction_velocity >= 0);
  if (friction_velocity == 0) return 0;
  return Inverse([](double wind_speed) { return FrictionVelocity(wind_speed); }, friction_velocity);
}

double WindSpeedAt10m(double wind_speed, double height) {
  assert(wind_speed >= 0 && height >= 1 && height <= 100);
  if (wind_speed == 0) return 0;
  return Inverse([&](double at_10m) { return WindSpeedAt(height, at_10m); }, wind_speed);
}

}  // namespace albtpu
