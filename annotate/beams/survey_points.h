// The chosen points of a part of a file as columns, in the coordinates of the file.
#pragma once

#include <cstddef>
#include <vector>

namespace albtpu::annotate {

// Element i of each column belongs to point i. Columns that the source of the incidence does not need may be empty.
struct SurveyPoints {
  std::vector<double> x, y;         // In the horizontal unit of the file: metres, feet or degrees.
  std::vector<double> z;            // In the vertical unit.
  std::vector<double> times;        // GPS time as the file states it.
  std::vector<double> scan_angles;  // degree, positive to the right of the flight direction.
  std::vector<double>
      pulse_surface;  // z of the return from the water surface of the same pulse; NaN if there is none.

  std::size_t size() const { return z.size(); }
};

}  // namespace albtpu::annotate
