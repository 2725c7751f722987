#include "generator/sea_state.h"

#include <array>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

constexpr int kDirections = 32;  // of the half plane; Psi is even in k
constexpr double kLogWavenumberStep = 0.02;

// Adds the integral of integrand(k, psi) Psi(k, psi) over the whole plane to `sum`.
template <typename Value, typename Integrand>
Value IntegrateOverWavenumbers(const SeaState& sea, Value sum, const Integrand& integrand) {
  const auto [lowest, highest] = sea.energetic_range();
  const int steps = static_cast<int>(std::ceil(std::log(highest / lowest) / kLogWavenumberStep));
  const double step = std::log(highest / lowest) / steps;
  const double d_psi = std::numbers::pi / kDirections;
  std::array<double, kDirections> spreading;
  for (int j = 0; j < kDirections; ++j) spreading[j] = sea.FrozenSpreading((j + 0.5) * d_psi);
  for (int i = 0; i <= steps; ++i) {
    const double k = lowest * std::exp(i * step);
    const double trapezoid = i == 0 || i == steps ? 0.5 : 1.0;
    const double ring =
        2 * k * sea.spectrum()(k) * step * d_psi * trapezoid;  // S/k times k dk, both half planes
    for (int j = 0; j < kDirections; ++j) sum += ring * spreading[j] * integrand(k, (j + 0.5) * d_psi);
  }
  return sum;
}

}  // namespace

SeaState::SeaState(double wind_speed_10m, double fetch, Cosine2sSpreading spreading)
    : spectrum_(wind_speed_10m, fetch), spreading_(spreading) {}

double SeaState::FrozenSpreading(double psi) const {
  return 0.5 * (spreading_(psi) + spreading_(psi + std::numbers::pi));
}

double SeaState::Psi(double k, double psi) const { return spectrum_(k) / k * FrozenSpreading(psi); }

double SeaState::DirectionalPsi(double k, double psi) const { return spectrum_(k) / k * spreading_(psi); }

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
