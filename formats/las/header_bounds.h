// The bounds of points that the header of their file states, beside those that the points have.
#pragma once

#include <array>
#include <string>

#include "formats/las/las_header.h"

namespace albtpu::formats {

// Of points, in the coordinates of their file; meaningless if there are none.
struct LasBounds {
  std::array<double, 3> least, greatest;
};

// "x 0 to 8 instead of 3 to 8": the bounds of the header that are not those of the points. Empty without points.
// `metres`: of a unit of each axis.
std::string WrongBounds(const LasHeader& header, const LasBounds& box, const std::array<double, 3>& metres);

// "x": the axis whose bounds are those of the points with another offset or another scale, so that one of the three is
// wrong, and nothing says which. Empty if there is none.
std::string ContradictedAxis(const LasHeader& header, const LasBounds& box, const std::array<double, 3>& metres);

}  // namespace albtpu::formats
