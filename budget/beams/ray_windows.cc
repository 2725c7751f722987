#include "budget/beams/ray_windows.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

#include "budget/beams/return_pair.h"

namespace albtpu {
namespace {

// More rays do not make a better start.
constexpr std::size_t kMaxRays = 600;
constexpr std::size_t kMinRays = 6;

}  // namespace

std::optional<KnotState> WhereRaysMeet(std::span<const AirRay> rays, double time) {
  if (rays.size() < kMinRays) return std::nullopt;
  const std::size_t stride = (rays.size() + kMaxRays - 1) / kMaxRays;
  const std::size_t count = (rays.size() + stride - 1) / stride;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i) centre += rays[i * stride].water_point / static_cast<double>(count);

  std::vector<double> weights(count, 1), distances(count);
  KnotState state = KnotState::Zero();
  for (int round = 0; round <= 8; ++round) {
    KnotMatrix normal = KnotMatrix::Zero();
    KnotState right = KnotState::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      const AirRay& ray = rays[i * stride];
      const double dt = ray.time - time;
      const Eigen::Matrix3d q =
          weights[i] * (Eigen::Matrix3d::Identity() - ray.direction * ray.direction.transpose());
      const Eigen::Vector3d qs = q * (ray.water_point - centre);
      normal.topLeftCorner<3, 3>() += q;
      normal.topRightCorner<3, 3>() += dt * q;
      normal.bottomRightCorner<3, 3>() += dt * dt * q;
      right.head<3>() += qs;
      right.tail<3>() += dt * qs;
    }
    normal.bottomLeftCorner<3, 3>() = normal.topRightCorner<3, 3>().transpose();
    const Eigen::SelfAdjointEigenSolver<KnotMatrix> solver(normal);
    const KnotState& values = solver.eigenvalues();
    if (!(values[0] > 1e-12 * values[5])) return std::nullopt;
    state = solver.eigenvectors() * (solver.eigenvectors().transpose() * right).cwiseQuotient(values);
    for (std::size_t i = 0; i < count; ++i) {
      const AirRay& ray = rays[i * stride];
      const Eigen::Vector3d gap =
          centre + state.head<3>() + (ray.time - time) * state.tail<3>() - ray.water_point;
      distances[i] = gap.cross(ray.direction).norm();
    }
    const double scale = std::max(Median(distances), 1e-6);
    for (std::size_t i = 0; i < count; ++i) {
      const double e = distances[i] / scale;
      weights[i] = 1 / (1 + e * e);
    }
  }
  state.head<3>() += centre;
  return state;
}

}  // namespace albtpu
