// Two returns of one pulse, both from below the water, and the ray in air that they tell.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace albtpu {

// Positions in a local frame in metres: x grid east, y grid north, z up in the vertical datum of the points.
struct ReturnPair {
  double time = 0;                // GPS time as the points state it.
  Eigen::Vector3d upper, lower;   // The return nearer to the surface, and the deeper one.
};

// The straight line of a beam in air.
struct AirRay {
  double time = 0;
  Eigen::Vector3d water_point;  // Where it met the water.
  Eigen::Vector3d direction;    // Unit vector from the sensor down to the water.
  double separation = 0;        // m between the two returns; the longer, the better the direction is known.
};

// The ray of a pair over water at height `water_height`, of index `index`. None if a return lies above the water, if
// the two are nearer than `least_separation` [m], or if no ray in air refracts into their direction.
std::optional<AirRay> RayOfPair(const ReturnPair& pair, double water_height, double index,
                                double least_separation = 1);

}  // namespace albtpu
