#include "sea/spectra/elfouhaily_spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

constexpr double kGravityCapillary = 370;  // k_m, rad/m, of the minimum phase speed; Eq. 24
constexpr double kMinPhaseSpeed = 0.23;    // c_m, m/s
constexpr double kFetchScale = 2.2e4;      // X_0 of Eq. 37
constexpr double kAlmostDevelopedOmega = 1.01 * kFullyDevelopedOmega;

// Gravity and capillarity, Eq. 24.
double PhaseSpeed(double k) { return std::sqrt(kGravity / k * (1 + std::pow(k / kGravityCapillary, 2))); }

// Eq. 44, natural logarithms; never negative.
double ShortWaveLevel(double friction_velocity) {
  const double excess = std::log(friction_velocity / kMinPhaseSpeed);
  return std::max(0.0, 0.01 * (1 + (excess > 0 ? 3 : 1) * excess));
}

}  // namespace

double ElfouhailySpectrum::InverseWaveAge(double wind_speed_10m, double fetch) {
  const double x = fetch * kGravity / std::pow(wind_speed_10m, 2);
  return kFullyDevelopedOmega * std::pow(std::tanh(std::pow(x / kFetchScale, 0.4)), -0.75);
}

double ElfouhailySpectrum::FullyDevelopedFetch(double wind_speed_10m) {
  const double tanh = std::pow(kAlmostDevelopedOmega / kFullyDevelopedOmega, -1 / 0.75);
  return kFetchScale * std::pow(std::atanh(tanh), 1 / 0.4) * std::pow(wind_speed_10m, 2) / kGravity;
}

ElfouhailySpectrum::ElfouhailySpectrum(double wind_speed_10m, double fetch)
    : omega_(InverseWaveAge(wind_speed_10m, fetch)),
      peak_(omega_),
      friction_velocity_(FrictionVelocity(wind_speed_10m)) {
  assert(wind_speed_10m > 0 && fetch > 0);
  k_p_ = kGravity * std::pow(omega_ / wind_speed_10m, 2);
  c_p_ = PhaseSpeed(k_p_);
  alpha_p_ = 6e-3 * std::sqrt(omega_);  // Eq. 34
  alpha_m_ = ShortWaveLevel(friction_velocity_);
}

double ElfouhailySpectrum::operator()(double k) const {
  const double c = PhaseSpeed(k);
  const double root = std::sqrt(k / k_p_) - 1;
  const double pierson_moskowitz = std::exp(-1.25 * std::pow(k_p_ / k, 2));  // Eq. 2
  const double jonswap = peak_(k / k_p_);                                    // Eq. 3
  const double long_waves = 0.5 * alpha_p_ * c_p_ / c * pierson_moskowitz * jonswap *
                            std::exp(-omega_ / std::sqrt(10.0) * root);  // Eq. 31, 32
  // Eq. 40, 41. As printed B_h has no cut-off below the peak, so the integral of S diverges at k = 0: here it
  // takes that of Pierson and Moskowitz, as in McDaniel (2001). Some authors also apply the peak enhancement, which
  // changes S only where B_h is negligible.
  const double short_waves = 0.5 * alpha_m_ * kMinPhaseSpeed / c * pierson_moskowitz *
                             std::exp(-0.25 * std::pow(k / kGravityCapillary - 1, 2));
  return (long_waves + short_waves) / (k * k * k);
}

double ElfouhailySpectrum::Delta(double k) const {
  // Eq. 57 with the constants of Eq. 59. Far from the peak and from k_m only the first term remains: the ratio of
  // waves along the wind to waves across it is exp(ln(2) / 2) = sqrt(2).
  const double c = PhaseSpeed(k);
  const double a_m = 0.13 * friction_velocity_ / kMinPhaseSpeed;
  return std::tanh(std::numbers::ln2 / 4 + 4 * std::pow(c / c_p_, 2.5) + a_m * std::pow(kMinPhaseSpeed / c, 2.5));
}

double ElfouhailySpectrum::Spreading(double k, double psi) const {
  return (1 + Delta(k) * std::cos(2 * psi)) / (2 * std::numbers::pi);
}

WavenumberRange ElfouhailySpectrum::energetic_range() const {
  // Below 0.3 k_p Eq. 2 is under exp(-13.9). At the upper end Eq. 41 ends the short waves, exp(-16) at 9 k_m; in
  // light wind, which raises no short waves, Eq. 32 ends the long ones, here at exp(-8).
  const double end_of_long_waves = k_p_ * std::pow(1 + 8 * std::sqrt(10.0) / omega_, 2);
  return {0.3 * k_p_, std::max(9 * kGravityCapillary, end_of_long_waves)};
}

std::string ElfouhailySpectrum::name() const {
  return "Elfouhaily et al. (1997) with its own spreading, drag law of Wu (1982)";
}

std::string ElfouhailySpectrum::reference() const {
  return "Elfouhaily et al. (1997), doi:10.1029/97JC00467; Wu (1982), doi:10.1029/JC087iC12p09704";
}

std::string ElfouhailySpectrum::departures() const {
  return "Fully developed, the significant wave height is 1.19 to 1.22 of Pierson-Moskowitz (0.0214 s2/m "
         "times the square of the wind at 10 m), the mean square slope 1.0 to 1.25 times Cox and Munk (1954) "
         "from 3 m/s on, 1.5 times at 2 m/s and 2.2 times at 1 m/s. Below 2.75 m/s the model has no short "
         "waves: all slope is in its long ones.";
}

}  // namespace albtpu
