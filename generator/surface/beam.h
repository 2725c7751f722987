// A laser beam as a set of rays.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sea/response/closed_form.h"

namespace albtpu {

// A ray in coordinates about the point where the axis of the beam meets the water. At height z its horizontal position
// is `at_zero + z * per_height`.
struct Ray {
  Eigen::Vector3d direction;  // unit vector, downward
  Eigen::Vector2d at_zero;    // m, where it crosses z = 0
  Eigen::Vector2d per_height() const { return direction.head<2>() / direction.z(); }
};

// Immutable. The rays sample the cross-section by a sunflower spiral (golden angle, radii of equal power), so that all
// have equal weight. A gaussian beam ends with the spiral, at the radius that holds 1 - 1/(2 rays) of its power.
class Beam {
 public:
  Beam(const BeamOptions& options, int ray_count);

  const BeamOptions& options() const { return options_; }
  Eigen::Vector2d azimuth_direction() const;  // unit vector
  Eigen::Vector2d per_height() const;         // of the axis, as Ray::per_height
  int ray_count() const { return static_cast<int>(cross_section_.size()); }

  // The rays about a point of the water that lies `elevation` [m] above the mean surface. The elevation matters only
  // for a point source.
  std::vector<Ray> Rays(double elevation) const;

 private:
  BeamOptions options_;
  Eigen::Vector3d axis_;
  // At the mean surface, relative to the axis and perpendicular to it, m.
  std::vector<Eigen::Vector3d> cross_section_;
};

}  // namespace albtpu
