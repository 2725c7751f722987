#include "validation/published/angle_method.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "generator/math/statistics.h"

namespace albtpu {
namespace {

double Horizontal(double refracted, double delta) { return std::tan(refracted + delta); }  // Eq. 24
double Vertical(double refracted, double delta) {                                          // Eq. 25, 26
  return std::cos(refracted) / std::cos(refracted + delta);
}

}  // namespace

AngleMethodUncertainty AngleMethod(double refracted, double two_sigma_angle) {
  constexpr double kCut = 8;    // standard deviations
  constexpr int kPerSigma = 4;  // nodes
  constexpr int kNodes = 2 * static_cast<int>(kCut) * kPerSigma + 1;
  assert(two_sigma_angle >= 0 && refracted + kCut / 2 * two_sigma_angle < std::numbers::pi / 2);

  // Differences from the values at delta = 0, to lose little to rounding where the variance is small.
  const double horizontal_still = Horizontal(refracted, 0), vertical_still = Vertical(refracted, 0);
  double weights = 0, x = 0, x_squared = 0, z = 0, z_squared = 0;
  for (int i = 0; i < kNodes; ++i) {
    const double t = static_cast<double>(i) / kPerSigma - kCut;
    const double weight = std::exp(-0.5 * t * t);
    const double horizontal = Horizontal(refracted, 0.5 * two_sigma_angle * t) - horizontal_still;
    const double vertical = Vertical(refracted, 0.5 * two_sigma_angle * t) - vertical_still;
    weights += weight;
    x += weight * horizontal;
    x_squared += weight * horizontal * horizontal;
    z += weight * vertical;
    z_squared += weight * vertical * vertical;
  }
  const auto two_sigma = [&](double sum, double squares) {
    return 2 * std::sqrt(squares / weights - (sum / weights) * (sum / weights));
  };
  return {two_sigma(x, x_squared), two_sigma(z, z_squared)};
}

AngleMethodUncertainty AngleMethodByDraws(double refracted, double two_sigma_angle, int draws, NormalStream stream) {
  std::vector<double> normals(draws);
  stream.Fill(normals);
  const Eigen::ArrayXd delta = 0.5 * two_sigma_angle * Eigen::Map<const Eigen::ArrayXd>(normals.data(), draws);
  return {TwoSigma((refracted + delta).tan()).value, TwoSigma(std::cos(refracted) / (refracted + delta).cos()).value};
}

}  // namespace albtpu
