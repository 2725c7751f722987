#include "sea/spectra/wind_profile.h"

#include <cmath>

namespace albtpu {

double FrictionVelocity(double wind_speed_10m) {
  return std::sqrt(1e-3 * (0.8 + 0.065 * wind_speed_10m)) * wind_speed_10m;
}

double WindSpeedAt(double height, double wind_speed_10m) {
  constexpr double kVonKarman = 0.4;
  return wind_speed_10m + FrictionVelocity(wind_speed_10m) / kVonKarman * std::log(height / 10);
}

}  // namespace albtpu
