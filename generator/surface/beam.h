// The rays that a laser beam is made of.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sea/response/footprint.h"

namespace albtpu {

// A ray in coordinates about the point where the axis of the beam meets the water. At height z it stands over
// `at_zero + z * per_height`.
struct Ray {
  Eigen::Vector3d direction;  // unit vector, downward
  Eigen::Vector2d at_zero;    // m, where it crosses z = 0
  Eigen::Vector2d per_height() const { return direction.head<2>() / direction.z(); }
};

// Immutable. The rays sample the cross-section evenly by a sunflower spiral (the golden angle, radii of equal
// power), so that all weigh alike; a gaussian beam is cut where the spiral ends, outside of 1 - 1/(2 rays) of
// its power.
class Beam {
 public:
  Beam(const BeamOptions& options, int ray_count);

  const BeamOptions& options() const { return options_; }
  Eigen::Vector2d azimuth_direction() const;  // unit vector
  Eigen::Vector2d per_height() const;         // of the axis, as Ray::per_height
  int ray_count() const { return static_cast<int>(cross_section_.size()); }

  // The rays about a point of the water that lies `elevation` above the mean surface. Only a point source
  // feels it.
  std::vector<Ray> Rays(double elevation) const;

 private:
  BeamOptions options_;
  Eigen::Vector3d axis_;
  std::vector<Eigen::Vector3d>
      cross_section_;  // at the mean surface, relative to the axis, perpendicular to it
};

}  // namespace albtpu
