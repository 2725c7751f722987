// What a beam through one surface reports, minus what is true, and the slopes that it answers to.
#pragma once

#include <Eigen/Core>

#include "generator/ray_tracer.h"

namespace albtpu {

// Errors are linear in the depth d.
struct BeamErrors {
  Eigen::Vector2d tangent;               // t - t_still
  Eigen::Vector2d horizontal_offset;     // m, and
  Eigen::Vector2d horizontal_per_depth;  // the spot's horizontal error is offset + d per_depth
  double vertical_offset;                // m, the same of elevation
  double vertical_per_depth;

  Eigen::Vector2d mean_slope = Eigen::Vector2d::Zero();  // of MeanSlope; zero where it is not asked for
  double mean_square_slope = 0;                          // of the facets that the rays met
};

// Still water would put the spot t_still d from the meeting and make the path d sec_still long; the true
// centroid is the traced one, and the depth that is reported is the mean path over sec_still.
inline BeamErrors ErrorsOf(const TracedBeam& traced, const TracedBeam& still) {
  const Eigen::Vector2d tangent = traced.tangent - still.tangent;
  return {tangent, -traced.height_tangent, -tangent, -traced.height_secant / still.secant,
          1 - traced.secant / still.secant};
}

}  // namespace albtpu
