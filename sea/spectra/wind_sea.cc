#include "sea/spectra/wind_sea.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

// std::lgamma() writes the sign to a variable that all threads share.
double LogGamma(double x) {
  int sign = 0;
  return lgamma_r(x, &sign);
}

}  // namespace

Cosine2sSpreading::Cosine2sSpreading(double s)
    : s_(s),
      normalization_(std::exp2(2 * s - 1) / std::numbers::pi * std::exp(2 * LogGamma(s + 1) - LogGamma(2 * s + 1))) {
  assert(s > 0);
}

double Cosine2sSpreading::operator()(double psi) const {
  return normalization_ * std::pow(std::abs(std::cos(psi / 2)), 2 * s_);
}

JonswapPeak::JonswapPeak(double omega)
    : gamma_(1.7 + 6 * std::log10(std::clamp(omega, 1.0, 5.0))), sigma_(0.08 * (1 + 4 / (omega * omega * omega))) {}

double JonswapPeak::operator()(double ratio) const {
  const double from_peak = std::sqrt(ratio) - 1;
  return std::pow(gamma_, std::exp(-(from_peak * from_peak) / (2 * (sigma_ * sigma_))));
}

double FrictionVelocity(double wind_speed_10m) {
  return std::sqrt(1e-3 * (0.8 + 0.065 * wind_speed_10m)) * wind_speed_10m;
}

double WindSpeedAt(double height, double wind_speed_10m) {
  constexpr double kVonKarman = 0.4;
  return wind_speed_10m + FrictionVelocity(wind_speed_10m) / kVonKarman * std::log(height / 10);
}

}  // namespace albtpu
