// The path of a beam from the sensor through still water to the bottom.
#pragma once

namespace albtpu {

// Where a beam meets the water, as the horizontal distance r [m] from the sensor. The sensor is `height` > 0 above the
// surface, the bottom point `depth` >= 0 below it, at the horizontal distance `distance` >= 0; all in m. `index` is
// that of the water, at least 1.
//
// r is the root of Snell's law, sin(incidence) = n sin(refracted):
//     f(r) = r / sqrt(r^2 + H^2) - n (D - r) / sqrt((D - r)^2 + d^2) = 0,
// f increases from f(0) <= 0 to f(D) >= 0 (Fermat's principle), so there is one root.
double DistanceToWater(double distance, double height, double depth, double index);

}  // namespace albtpu
