#include "sea/spectra/elfouhaily_spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "sea/spectra/wind_profile.h"

namespace albtpu {
namespace {

constexpr double kGravityCapillary = 370;  // k_m, rad/m, where the phase speed is least; Eq. 24
constexpr double kLeastPhaseSpeed = 0.23;  // c_m, m/s
constexpr double kFetchScale = 2.2e4;      // X_0 of Eq. 37
constexpr double kAlmostDevelopedOmega = 1.01 * kFullyDevelopedOmega;

double Square(double x) { return x * x; }

// Gravity and capillarity, Eq. 24.
double PhaseSpeed(double k) { return std::sqrt(kGravity / k * (1 + Square(k / kGravityCapillary))); }

// Eq. 44, natural logarithms; never negative.
double ShortWaveLevel(double friction_velocity) {
  const double excess = std::log(friction_velocity / kLeastPhaseSpeed);
  return std::max(0.0, 0.01 * (1 + (excess > 0 ? 3 : 1) * excess));
}

}  // namespace

double ElfouhailySpectrum::InverseWaveAge(double wind_speed_10m, double fetch) {
  const double x = fetch * kGravity / Square(wind_speed_10m);
  return kFullyDevelopedOmega * std::pow(std::tanh(std::pow(x / kFetchScale, 0.4)), -0.75);
}

double ElfouhailySpectrum::FullyDevelopedFetch(double wind_speed_10m) {
  const double tanh = std::pow(kAlmostDevelopedOmega / kFullyDevelopedOmega, -1 / 0.75);
  return kFetchScale * std::pow(std::atanh(tanh), 1 / 0.4) * Square(wind_speed_10m) / kGravity;
}

ElfouhailySpectrum::ElfouhailySpectrum(double wind_speed_10m, double fetch)
    : omega_(InverseWaveAge(wind_speed_10m, fetch)),
      peak_(omega_),
      friction_velocity_(FrictionVelocity(wind_speed_10m)) {
  assert(wind_speed_10m > 0 && fetch > 0);
  k_p_ = kGravity * Square(omega_ / wind_speed_10m);
  c_p_ = PhaseSpeed(k_p_);
  alpha_p_ = 6e-3 * std::sqrt(omega_);  // Eq. 34
  alpha_m_ = ShortWaveLevel(friction_velocity_);
}

double ElfouhailySpectrum::operator()(double k) const {
  const double c = PhaseSpeed(k);
  const double root = std::sqrt(k / k_p_) - 1;
  const double pierson_moskowitz = std::exp(-1.25 * Square(k_p_ / k));  // Eq. 2
  const double jonswap = peak_(k / k_p_);                               // Eq. 3
  const double long_waves = 0.5 * alpha_p_ * c_p_ / c * pierson_moskowitz * jonswap *
                            std::exp(-omega_ / std::sqrt(10.0) * root);  // Eq. 31, 32
  // Eq. 40, 41. As printed B_h has no cut-off below the peak, and the integral of S diverges at k = 0: it
  // gets that of Pierson and Moskowitz, as in McDaniel (2001). The peak enhancement, which some put here too,
  // would change S where B_h is next to nothing.
  const double short_waves = 0.5 * alpha_m_ * kLeastPhaseSpeed / c * pierson_moskowitz *
                             std::exp(-0.25 * Square(k / kGravityCapillary - 1));
  return (long_waves + short_waves) / (k * k * k);
}

double ElfouhailySpectrum::Delta(double k) const {
  // Eq. 57 with the constants of Eq. 59. Far from the peak and from k_m the first term is left: waves along
  // and across the wind stand as exp(ln(2) / 2) = sqrt(2) to 1.
  const double c = PhaseSpeed(k);
  const double a_m = 0.13 * friction_velocity_ / kLeastPhaseSpeed;
  return std::tanh(std::numbers::ln2 / 4 + 4 * std::pow(c / c_p_, 2.5) +
                   a_m * std::pow(kLeastPhaseSpeed / c, 2.5));
}

double ElfouhailySpectrum::Spreading(double k, double psi) const {
  return (1 + Delta(k) * std::cos(2 * psi)) / (2 * std::numbers::pi);
}

WavenumberRange ElfouhailySpectrum::energetic_range() const {
  // Below 0.3 k_p Eq. 2 is under exp(-13.9). Above, short waves end by Eq. 41, exp(-16) at 9 k_m; where there
  // are none (light wind) long ones by Eq. 32, here at exp(-8).
  const double end_of_long_waves = k_p_ * Square(1 + 8 * std::sqrt(10.0) / omega_);
  return {0.3 * k_p_, std::max(9 * kGravityCapillary, end_of_long_waves)};
}

}  // namespace albtpu
