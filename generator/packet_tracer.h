// A collimated beam through one piece of sea surface, several rays at a time in single precision.
//
// The same geometry as height_field.h and the same means as ray_tracer.h, which are its slow twins. Single
// precision is enough because everything is small: positions and heights count from where the axis of the
// beam meets the water, and what is summed are departures from still water, computed without cancellation.
#pragma once

#include <Eigen/Core>

#include "generator/height_window.h"
#include "generator/ray_bundle.h"
#include "generator/ray_tracer.h"

namespace albtpu {

// Means over the rays of a bundle.
struct TracedBundle {
  TracedBeam beam;
  double height;  // m, of where the rays met the water
  // Of the facets over or under which the rays cross z = 0, where they would meet the water were its height
  // not to shift them: linear and quadratic in the heights.
  Eigen::Vector2d undisturbed_slope;
  Eigen::Vector3d undisturbed_slope_squares;  // as SlopeSquares
  Eigen::Vector2d undisturbed_height_slope;   // m, covariance of height and slope (height_slope_product.h)
  int met_alone;  // rays that had to be met one by one, because their packet did not settle
};

// On the best instruction set of this machine. A result depends on that, by rounding, and on nothing else.
TracedBundle TracePackets(const RayBundle& rays, const HeightWindow& surface);

// The same without what is undisturbed: the single-precision twin of Trace(rays, surface, refractive_index).
TracedBeam Trace(const RayBundle& rays, const HeightWindow& surface);

}  // namespace albtpu
