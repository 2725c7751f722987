// A triangulated piece of sea surface in single precision.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "generator/height_field.h"

namespace albtpu {

// The surface of HeightField in memory that somebody else owns.
struct HeightWindow {
  const float* heights;   // m, at ((ix - centre) spacing, (iy - centre) spacing), ix slow
  int points;             // along a side, odd, at least 3
  std::ptrdiff_t stride;  // floats from a row to the next, at least `points`
  float spacing;          // m

  HeightField::Triangle TriangleAt(const Eigen::Vector2d& x) const;
  HeightField::Facet FacetOf(const HeightField::Triangle& triangle) const;
  double reach() const { return (points - 1) / 2 * static_cast<double>(spacing); }
};

}  // namespace albtpu
