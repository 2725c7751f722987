#include "sea/spectra/apel_spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

constexpr double kSaturation = 0.00195;  // A of Eq. 1, as given below it
constexpr double kRollOff = 100;         // rad/m, Eq. 10
constexpr double kResonance = 400;       // rad/m, Eq. 11
constexpr double kResonanceWidth = 450;  // rad/m, Eq. 11
constexpr double kResonanceGain = 0.8;   // a of Eq. 11, m
constexpr double kDissipation = 6283;    // rad/m, Eq. 13

// Eq. 14 with sqrt(2 pi) in place of its inverse: the integral of exp(-phi^2 / (2 phi_s^2)) over a full turn.
double DirectionalIntegral(double k_over_k_p) {
  const double phi_s = 1 / std::sqrt(0.28 + 10 * std::pow(k_over_k_p, -1.3));
  return std::sqrt(2 * std::numbers::pi) * phi_s * std::erf(std::numbers::pi / (phi_s * std::numbers::sqrt2));
}

}  // namespace

double ApelSpectrum::InverseWaveAge(double wind_speed_10m, double fetch) {
  const double k_0 = kGravity / std::pow(wind_speed_10m, 2);  // Eq. 4
  return std::max(kFullyDevelopedOmega, 22 * std::pow(k_0 * fetch, -0.33));
}

double ApelSpectrum::FullyDevelopedFetch(double wind_speed_10m) {
  const double k_0 = kGravity / std::pow(wind_speed_10m, 2);
  return std::pow(22 / kFullyDevelopedOmega, 1 / 0.33) / k_0;
}

ApelSpectrum::ApelSpectrum(double wind_speed_10m, double fetch, Cosine2sSpreading spreading)
    : omega_(InverseWaveAge(wind_speed_10m, fetch)), peak_(omega_), spreading_(spreading) {
  assert(wind_speed_10m > 0 && fetch > 0);
  k_p_ = kGravity / std::pow(wind_speed_10m, 2) * std::pow(omega_, 2);      // Eq. 3
  s_ = std::pow(10, -4.95 + 3.45 * (1 - std::exp(-wind_speed_10m / 4.7)));  // Eq. 12, base 10
}

double ApelSpectrum::operator()(double k) const {
  const double ratio = k / k_p_;
  const double pierson_moskowitz = std::exp(-1.25 / std::pow(ratio, 2));                        // Eq. 2
  const double jonswap = peak_(ratio);                                                          // Eq. 6-9
  const double roll_off = 1 / (1 + std::pow(k / kRollOff, 2));                                  // Eq. 10
  const double resonance = kResonanceGain * k / std::cosh((k - kResonance) / kResonanceWidth);  // Eq. 11
  const double dissipation = std::exp(-std::pow(k / kDissipation, 2));                          // Eq. 13
  return kSaturation / (k * k * k) * pierson_moskowitz * jonswap * (roll_off + s_ * resonance) * dissipation *
         DirectionalIntegral(ratio);  // Eq. 1
}

WavenumberRange ApelSpectrum::energetic_range() const {
  // Below 0.3 k_p Eq. 2 is under exp(-13.9); above 2 k_dis Eq. 13 is under exp(-4) and Eq. 11 under 1e-10.
  return {0.3 * k_p_, 2 * kDissipation};
}

std::string ApelSpectrum::name() const { return "Apel (1994) with the fetch law of JONSWAP, cosine-2S spreading"; }

std::string ApelSpectrum::reference() const { return "Apel (1994), doi:10.1029/94JC00846"; }

std::string ApelSpectrum::departures() const {
  return "Fully developed, the significant wave height is 0.95 of Pierson-Moskowitz (0.0214 s2/m times the "
         "square of the wind at 10 m), the mean square slope 1.6 to 2.7 times Cox and Munk (1954). Below "
         "some 10 km of fetch waves are 2 to 3 times lower than JONSWAP: values at short fetch are not "
         "conservative.";
}

}  // namespace albtpu
