// What a beam through one surface reports, minus what is true.
#pragma once

#include <Eigen/Core>
#include <array>

#include "generator/surface/ray_tracer.h"

namespace albtpu {

// Errors are linear in the depth d.
struct BeamErrors {
  Eigen::Vector2d tangent = Eigen::Vector2d::Zero();  // t - t_still
  // The spot's horizontal error is offset [m] + d per_depth,
  Eigen::Vector2d horizontal_offset = Eigen::Vector2d::Zero();
  Eigen::Vector2d horizontal_per_depth = Eigen::Vector2d::Zero();
  double vertical_offset = 0;  // m, the same of elevation
  double vertical_per_depth = 0;
};

// Still water would put the spot t_still d from the meeting and make the path d sec_still long; the true
// centroid is the traced one, and the depth that is reported is the mean path over sec_still.
inline BeamErrors ErrorsOf(const TracedBeam& traced, const TracedBeam& still) {
  const Eigen::Vector2d tangent = traced.tangent - still.tangent;
  return {tangent, -traced.height_tangent, -tangent, -traced.height_secant / still.secant,
          1 - traced.secant / still.secant};
}

// What one realization of the sea does to a beam: the errors on its surface and, where the surface is traced
// the other way up too (which a Gaussian sea is as likely to be), on that. Each has a share in the
// realization's means; shares add up to 1.
struct BeamRealization {
  struct Part {
    double share = 0;
    BeamErrors errors;
  };
  std::array<Part, 2> parts;
  // Of the facets over which the rays cross z = 0 on the surface of parts[0], where that is known
  // (slope_moments.h, height_slope_product.h).
  Eigen::Vector2d mean_slope = Eigen::Vector2d::Zero();
  Eigen::Vector3d mean_squares = Eigen::Vector3d::Zero();
  Eigen::Vector2d height_slope = Eigen::Vector2d::Zero();  // m, their covariance over the rays
};

}  // namespace albtpu
