// The path of a beam from the sensor through still water to a point below it.
#pragma once

namespace albtpu {

// The refractive index of sea water at 532 nm, for the directions of rays. Quan and Fry (1995), Eq. 3,
// doi:10.1364/AO.34.003477, gives 1.3415 at 20 degrees C and a salinity of 35, and 1.3350 without salt. The tables of
// the sea surface are made with 1.33 (kRefractiveIndex).
inline constexpr double kSeaWaterIndex = 1.34;

// The horizontal distance r [m], in [0, distance], from the sensor to the point where a beam meets the water. The
// sensor is `height` > 0 above the surface, the point `depth` below it, at the horizontal distance `distance` >= 0; all
// in m. `index` is that of the water, at least 1. A point at or above the surface (`depth` <= 0) is reached in a
// straight line and needs no water: r is `distance`.
//
// r is the root of Snell's law, sin(incidence) = n sin(refracted):
//     f(r) = r / sqrt(r^2 + H^2) - n (D - r) / sqrt((D - r)^2 + d^2) = 0,
// f increases from f(0) <= 0 to f(D) >= 0 (Fermat's principle), so there is one root.
//
// Its error is below 1e-9 m where height >= 30 m, depth <= 1000 m and the incidence is at most 80 degrees, and below
// 1e-9 of the distance where height >= 1 m and depth <= 1e6 m, whatever the incidence. It always takes the same
// operations, in the same order.
double DistanceToWater(double distance, double height, double depth, double index);

}  // namespace albtpu
