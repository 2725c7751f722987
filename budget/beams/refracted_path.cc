#include "budget/beams/refracted_path.h"

#include <cmath>

namespace albtpu {

double DistanceToWater(double distance, double height, double depth, double index) {
  constexpr int kSteps = 3;
  if (depth <= 0) return distance;
  // The angle of a straight line in water of reduced depth, refracted exactly at the surface.
  const double tangent = distance / (height + depth / index);
  const double sine_in_water = tangent / std::sqrt(1 + tangent * tangent) / index;
  double r = distance - depth * sine_in_water / std::sqrt(1 - sine_in_water * sine_in_water);
  for (int step = 0; step < kSteps; ++step) {
    const double rest = distance - r;
    const double air = std::sqrt(r * r + height * height);
    const double water = std::sqrt(rest * rest + depth * depth);
    const double f = r / air - index * rest / water;
    const double slope = height * height / (air * air * air) + index * depth * depth / (water * water * water);
    r -= f / slope;
  }
  return r;
}

}  // namespace albtpu
