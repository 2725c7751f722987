#include "generator/surface/beam.h"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>
#include <numbers>

namespace albtpu {

Beam::Beam(const BeamOptions& options, int ray_count) : options_(options) {
  assert(options.incidence >= 0 && options.incidence < std::numbers::pi / 2);
  assert(options.footprint > 0 && ray_count > 0 && options.source_height > 0);
  const Eigen::Vector2d along = azimuth_direction();
  axis_ << std::sin(options.incidence) * along, -std::cos(options.incidence);
  const Eigen::Vector3d across(-along.y(), along.x(), 0);
  const Eigen::Vector3d upward = axis_.cross(across);
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  cross_section_.reserve(ray_count);
  for (int j = 0; j < ray_count; ++j) {
    const double radius = options.footprint * RadiusOfPower(options.profile, (j + 0.5) / ray_count);
    cross_section_.push_back(radius * (std::cos(j * golden_angle) * upward + std::sin(j * golden_angle) * across));
  }
}

Eigen::Vector2d Beam::azimuth_direction() const { return {std::cos(options_.azimuth), std::sin(options_.azimuth)}; }

Eigen::Vector2d Beam::per_height() const { return axis_.head<2>() / axis_.z(); }

std::vector<Ray> Beam::Rays(double elevation) const {
  const bool collimated = std::isinf(options_.source_height);
  const double cos_incidence = std::cos(options_.incidence);
  std::vector<Ray> rays;
  rays.reserve(cross_section_.size());
  for (const Eigen::Vector3d& point : cross_section_) {
    Ray ray;
    Eigen::Vector3d origin = point;
    if (collimated) {
      ray.direction = axis_;
    } else {
      ray.direction = (axis_ * (options_.source_height / cos_incidence) + point).normalized();
      origin = -axis_ * ((options_.source_height - elevation) / cos_incidence);
    }
    ray.at_zero = origin.head<2>() - origin.z() * ray.per_height();
    rays.push_back(ray);
  }
  return rays;
}

}  // namespace albtpu
