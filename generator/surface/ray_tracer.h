// A beam through one piece of sea surface: where its rays meet the water and how they are refracted.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "generator/surface/beam.h"
#include "generator/surface/height_field.h"
#include "sea/response/unresolved_waves.h"

namespace albtpu {

// Means over the rays of a beam. Rays are straight below the surface, so these means give the centroid and the mean
// path exactly at every depth. Let h be the height of a ray's intersection above the mean of all intersections. At the
// depth d below that mean, the centroid has moved by `height_tangent + d tangent`, and the mean path length is
// `height_secant + d secant`.
struct TracedBeam {
  Eigen::Vector2d tangent;         // horizontal distance per unit of depth, of the refracted ray
  Eigen::Vector2d height_tangent;  // mean of h times the tangent, m
  double secant;                   // path length per unit of depth
  double height_secant;            // mean of h times the secant, m
  Eigen::Vector2d slope;           // of the facets that the rays intersect
  Eigen::Vector3d slope_squares;   // SlopeSquares of these facets
};

// `rays` are in the coordinates of `surface`.
TracedBeam Trace(const std::vector<Ray>& rays, const HeightField& surface, double refractive_index);

// The same beam with the mean effect of waves shorter than the grid of the surface.
TracedBeam WithUnresolvedWaves(TracedBeam beam, const UnresolvedWaves& unresolved);

}  // namespace albtpu
