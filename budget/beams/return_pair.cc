#include "budget/beams/return_pair.h"

#include <cmath>

namespace albtpu {

std::optional<AirRay> RayOfPair(const ReturnPair& pair, double water_height, double index,
                                double min_separation) {
  if (!(pair.upper.z() < water_height) || !(pair.lower.z() < pair.upper.z())) return std::nullopt;
  const Eigen::Vector3d between = pair.lower - pair.upper;
  const double separation = between.norm();
  if (!(separation >= min_separation)) return std::nullopt;
  const Eigen::Vector3d in_water = between / separation;
  const Eigen::Vector2d in_air = index * in_water.head<2>();
  const double cosine_squared = 1 - in_air.squaredNorm();
  if (!(cosine_squared > 0) || !std::isfinite(pair.time)) return std::nullopt;
  const double up = (water_height - pair.upper.z()) / -in_water.z();
  return AirRay{.time = pair.time,
                .water_point = pair.upper - up * in_water,
                .direction = Eigen::Vector3d(in_air.x(), in_air.y(), -std::sqrt(cosine_squared)),
                .separation = separation};
}

}  // namespace albtpu
