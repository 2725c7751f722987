#include "sea/response/refraction.h"

namespace albtpu {

double StillWaterRefraction(double incidence, double n) { return std::asin(std::sin(incidence) / n); }

SlopeGain SmallSlopeGain(double incidence, double n) {
  const double cos_refracted = std::cos(StillWaterRefraction(incidence, n));
  const double g = 1 - std::cos(incidence) / (n * cos_refracted);
  return {g / (cos_refracted * cos_refracted), g};
}

Eigen::Matrix2d TangentResponse(double incidence, double azimuth, double n) {
  const SlopeGain gain = SmallSlopeGain(incidence, n);
  const Eigen::Vector2d along(std::cos(azimuth), std::sin(azimuth));
  return gain.out_of_plane * Eigen::Matrix2d::Identity() +
         (gain.in_plane - gain.out_of_plane) * along * along.transpose();
}

// By central differences, whose error is some 1e-6 of the result.
Eigen::Matrix2d SecantCurvature(double incidence, double azimuth, double n) {
  constexpr double kStep = 1e-3;
  const Eigen::Vector3d incident(std::sin(incidence) * std::cos(azimuth),
                                 std::sin(incidence) * std::sin(azimuth), -std::cos(incidence));
  const auto secant = [&](double x, double y) {
    return RefractAtSlope(incident, Eigen::Vector2d(x, y) * kStep, n).secant;
  };
  const double xx = secant(1, 0) + secant(-1, 0) - 2 * secant(0, 0);
  const double yy = secant(0, 1) + secant(0, -1) - 2 * secant(0, 0);
  const double xy = (secant(1, 1) + secant(-1, -1) - secant(1, -1) - secant(-1, 1)) / 4;
  return (Eigen::Matrix2d() << xx, xy, xy, yy).finished() / (kStep * kStep);
}

}  // namespace albtpu
