// A collimated beam through one piece of sea surface, several rays at a time in single precision.
//
// The same geometry as height_field.h and the same means as ray_tracer.h, which are its slow twins. Single
// precision is enough because everything is small: positions and heights count from where the axis of the beam
// meets the water, and what is summed are departures from still water.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "generator/height_field.h"
#include "generator/ray_bundle.h"
#include "generator/ray_tracer.h"

namespace albtpu {

// A surface as of HeightField in single precision, in memory that somebody else owns.
struct HeightWindow {
  const float* heights;   // m, at ((ix - centre) spacing, (iy - centre) spacing), ix slow
  int points;             // along a side, odd, at least 3
  std::ptrdiff_t stride;  // from a row to the next, in floats, at least `points`
  float spacing;          // m

  // As of HeightField, in double precision.
  HeightField::Triangle TriangleAt(const Eigen::Vector2d& x) const;
  HeightField::Facet FacetOf(const HeightField::Triangle& triangle) const;
  double reach() const { return (points - 1) / 2 * static_cast<double>(spacing); }
};

// Means over the rays of a bundle.
struct TracedBundle {
  TracedBeam beam;
  double height;  // m, of where the rays met the water
  // Of the facets over or under which the rays cross z = 0: linear in the heights and quadratic, as a line
  // through the water would meet them did the heights not shift it.
  Eigen::Vector2d undisturbed_slope;
  Eigen::Vector3d undisturbed_slope_squares;  // as SlopeSquares
  int met_alone;  // rays that did not settle among their neighbours; they were met one by one, see Intersect
};

// On the best instruction set that this machine has.
TracedBundle TracePackets(const RayBundle& rays, const HeightWindow& surface);

}  // namespace albtpu
