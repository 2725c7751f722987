// The rays of a collimated beam as the packet tracer wants them: in single precision, neighbours together.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "generator/beam.h"

namespace albtpu {

// Immutable. All rays have one direction and enter water of one refractive index; they differ in where they
// cross z = 0. They are ordered along a Morton curve, so that a few that follow each other meet a few cells of
// the surface that lie side by side.
class RayBundle {
 public:
  // `beam` is collimated.
  RayBundle(const Beam& beam, double refractive_index) : RayBundle(beam.Rays(0), refractive_index) {}
  // `rays` have one direction; not empty.
  RayBundle(std::vector<Ray> rays, double refractive_index);

  int count() const { return count_; }
  double refractive_index() const { return refractive_index_; }
  const Eigen::Vector3d& direction() const { return direction_; }           // unit vector, downward
  Eigen::Vector2d per_height() const { return Ray{direction_, {}}.per_height(); }
  // Where the rays cross z = 0, m about the centre of the beam. Both go on past the last ray, repeating it, up
  // to a multiple of kPadding.
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  static constexpr int kPadding = 32;

 private:
  int count_;
  double refractive_index_;
  Eigen::Vector3d direction_;
  std::vector<float> x_, y_;
};

}  // namespace albtpu
