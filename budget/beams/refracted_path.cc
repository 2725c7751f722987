#include "budget/beams/refracted_path.h"

#include "budget/beams/refracted_path-inl.h"

namespace albtpu {

double DistanceToWater(double distance, double height, double depth, double index) {
  if (depth <= 0) return distance;
  return DistanceToStillWater(distance, height, depth, StillWater(index));
}

}  // namespace albtpu
