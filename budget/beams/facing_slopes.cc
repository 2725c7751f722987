#include "budget/beams/facing_slopes.h"

#include <Eigen/Core>

#include "sea/response/refraction.h"

namespace albtpu {
namespace {

// The angles, in the plane of incidence and across it, between the beam at `incidence` towards +x and the ray in air
// that follows from its path behind a facet of slope `slope`.
Eigen::Vector2d AngleBehind(double incidence, double index, const Eigen::Vector2d& slope) {
  const Eigen::Vector3d beam(std::sin(incidence), 0, -std::cos(incidence));
  const RefractedRay refracted = RefractAtSlope(beam, slope, index);
  const Eigen::Vector2d in_air = index * refracted.tangent / refracted.secant;
  const Eigen::Vector3d ray(in_air.x(), in_air.y(), -std::sqrt(1 - in_air.squaredNorm()));
  const Eigen::Vector3d outward(std::cos(incidence), 0, std::sin(incidence));
  const Eigen::Vector2d across(ray.dot(outward), ray.y());
  return across.norm() > 0 ? across * (std::atan2(across.norm(), ray.dot(beam)) / across.norm()) : across;
}

}  // namespace

// By central differences, whose error is some 1e-6 of the result.
FacingSlopes FacingSlopesAt(double incidence, double index) {
  constexpr double kStep = 1e-3;
  const auto f = [&](double x, double y) {
    return AngleBehind(incidence, index, Eigen::Vector2d(x, y) * kStep);
  };
  const double along = (f(1, 0).x() - f(-1, 0).x()) / (2 * kStep);
  const double across = (f(0, 1).y() - f(0, -1).y()) / (2 * kStep);
  const double laplacian =
      (f(1, 0).x() + f(-1, 0).x() + f(0, 1).x() + f(0, -1).x() - 4 * f(0, 0).x()) / (kStep * kStep);
  return {.gain = std::sqrt((along * along + across * across) / 2),
          .bias = std::tan(incidence) * along + laplacian / 2};
}

}  // namespace albtpu
