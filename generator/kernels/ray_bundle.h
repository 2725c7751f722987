// The rays of a collimated beam in the layout of the packet tracer: in single precision, with neighbours side by side.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "generator/surface/beam.h"

namespace albtpu {

// Immutable. All rays have the same direction and enter water of the same refractive index; they differ in where they
// cross z = 0. A Morton curve through these points is divided into strips of equal length. The rays are stored
// interleaved: the first of each strip, the second of each strip, and so on. A ray and the one kStrips before it
// therefore meet the water side by side.
class RayBundle {
 public:
  static constexpr int kStrips = 32;

  // `beam` is collimated.
  RayBundle(const Beam& beam, double refractive_index) : RayBundle(beam.Rays(0), refractive_index) {}
  // `rays` have one direction; not empty.
  RayBundle(const std::vector<Ray>& rays, double refractive_index);

  int count() const { return count_; }
  double refractive_index() const { return refractive_index_; }
  const Eigen::Vector3d& direction() const { return direction_; }  // unit vector, downward
  double x_per_height() const { return direction_.x() / direction_.z(); }
  double y_per_height() const { return direction_.y() / direction_.z(); }
  bool vertical() const { return direction_.x() == 0 && direction_.y() == 0; }

  // Where the rays cross z = 0, m from the centre of the beam. The last ray is repeated up to a multiple of kStrips.
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }

 private:
  int count_;
  double refractive_index_;
  Eigen::Vector3d direction_;
  std::vector<float> x_, y_;
};

}  // namespace albtpu
