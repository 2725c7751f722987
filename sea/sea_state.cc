#include "sea/sea_state.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

constexpr int kDirections = 32;  // of the half plane; Psi is even in k
constexpr double kDirectionStep = std::numbers::pi / kDirections;
constexpr double kLogWavenumberStep = 0.02;

std::array<double, kDirections> FrozenSpreadings(const SeaState& sea, double k) {
  std::array<double, kDirections> spreading;
  for (int j = 0; j < kDirections; ++j) spreading[j] = sea.FrozenSpreading(k, (j + 0.5) * kDirectionStep);
  return spreading;
}

// Adds the integral of integrand(k, psi) Psi(k, psi) over the whole plane to `sum`.
template <typename Value, typename Integrand>
Value IntegrateOverWavenumbers(const SeaState& sea, Value sum, const Integrand& integrand) {
  const auto [lowest, highest] = sea.energetic_range();
  const int steps = static_cast<int>(std::ceil(std::log(highest / lowest) / kLogWavenumberStep));
  const double step = std::log(highest / lowest) / steps;
  const double d_psi = kDirectionStep;
  std::array<double, kDirections> spreading = FrozenSpreadings(sea, lowest);
  for (int i = 0; i <= steps; ++i) {
    const double k = lowest * std::exp(i * step);
    if (sea.spectrum().spreading_varies_with_wavenumber()) spreading = FrozenSpreadings(sea, k);
    const double trapezoid = i == 0 || i == steps ? 0.5 : 1.0;
    const double ring = 2 * k * sea.S(k) * step * d_psi * trapezoid;  // S/k times k dk, for both half planes
    for (int j = 0; j < kDirections; ++j) sum += ring * spreading[j] * integrand(k, (j + 0.5) * d_psi);
  }
  return sum;
}

}  // namespace

SeaState::SeaState(const SeaOptions& options)
    : options_(options),
      spectrum_(MakeSpectrum(options.waves)),
      longest_wave_(2 * std::numbers::pi / options.corrected_above),
      height_scale_squared_(options.height_scale * options.height_scale) {
  assert(options.corrected_above > 0 && options.height_scale > 0);
  assert(longest_wave_ < spectrum_->energetic_range().highest);
}

SeaState::SeaState(double wind_speed_10m, double fetch)
    : SeaState(SeaOptions{.waves = WindSea{.wind_speed_10m = wind_speed_10m, .fetch = fetch}}) {}

double SeaState::FrozenSpreading(double k, double psi) const {
  return 0.5 * (spectrum_->Spreading(k, psi) + spectrum_->Spreading(k, psi + std::numbers::pi));
}

double SeaState::Psi(double k, double psi) const { return S(k) / k * FrozenSpreading(k, psi); }

double SeaState::DirectionalPsi(double k, double psi) const {
  return S(k) / k * spectrum_->Spreading(k, psi);
}

WavenumberRange SeaState::energetic_range() const {
  const auto [lowest, highest] = spectrum_->energetic_range();
  return {std::max(lowest, longest_wave_), highest};
}

Eigen::Matrix2d SlopeCovariance(const SeaState& sea,
                                const std::function<double(double k, double psi)>& weight) {
  return IntegrateOverWavenumbers(sea, Eigen::Matrix2d(Eigen::Matrix2d::Zero()), [&](double k, double psi) {
    const Eigen::Vector2d wave(k * std::cos(psi), k * std::sin(psi));
    return Eigen::Matrix2d(weight(k, psi) * wave * wave.transpose());
  });
}

Eigen::Matrix2d SlopeCovariance(const SeaState& sea) {
  return SlopeCovariance(sea, [](double, double) { return 1.0; });
}

double ElevationVariance(const SeaState& sea) {
  return IntegrateOverWavenumbers(sea, 0.0, [](double, double) { return 1.0; });
}

}  // namespace albtpu
