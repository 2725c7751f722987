// A beam through one piece of sea surface: where its rays meet the water and how they go on.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "generator/surface/beam.h"
#include "generator/surface/height_field.h"
#include "sea/response/unresolved_waves.h"

namespace albtpu {

// Means over the rays of a beam. Below the water a ray is straight, so these give the centroid and the mean
// path at every depth exactly: with h the height of a ray's meeting above the mean of all, at the depth d
// below that mean the centroid has moved by `height_tangent + d tangent`, and the mean path is `height_secant
// + d secant` long.
struct TracedBeam {
  Eigen::Vector2d tangent;         // horizontal per unit of depth, of the refracted ray
  Eigen::Vector2d height_tangent;  // mean of h times the tangent, m
  double secant;                   // path per unit of depth
  double height_secant;            // mean of h times the secant, m
  Eigen::Vector2d slope;           // of the facets that the rays met
  Eigen::Vector3d slope_squares;   // the same of SlopeSquares
};

// `rays` are in the coordinates of `surface`.
TracedBeam Trace(const std::vector<Ray>& rays, const HeightField& surface, double refractive_index);

// The same beam with the waves that are shorter than the grid of the surface.
TracedBeam WithUnresolvedWaves(TracedBeam beam, const UnresolvedWaves& unresolved);

}  // namespace albtpu
