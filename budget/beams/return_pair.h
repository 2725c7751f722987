// Two returns of one pulse, both from below the water, and the ray in air that follows from them.
//
// Derivation. The returns of a pulse lie on its straight path in water, so their difference has the direction w of the
// beam there. Snell's law keeps the horizontal part of n times the direction at a level surface: u_h = n w_h, and the
// direction u in air, downward and of length 1, follows. The path meets the water where the line through the returns
// does, S = P + w (h - P_z) / w_z. The line is the best one through two returns of equal error: it passes through both,
// so S is the same from either of them. All of this is exact for still water.
//
// Errors. Errors of `sigma` [m] of each return across the path turn w by sqrt(2) sigma / separation, and u by about n
// times that. A slope m of the water turns w by g m, with g = 1 - cos(theta) / (n cos(theta_r)), about 1/4, whatever
// the separation.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

namespace albtpu {

// Positions in a local frame in metres: x grid east, y grid north, z up in the vertical datum of the points.
struct ReturnPair {
  double time = 0;               // GPS time as the points state it.
  Eigen::Vector3d upper, lower;  // The return nearer to the surface, and the deeper one.
};

// The straight line of a beam in air.
struct AirRay {
  double time = 0;
  Eigen::Vector3d water_point;  // The point where it met the water.
  Eigen::Vector3d direction;    // Unit vector from the sensor down to the water.
  double separation = 0;        // m between the two returns; the longer, the better the direction is known.
};

// The ray of a pair over water at height `water_height`, of index `index`. None if a return lies above the water, if
// the two are nearer than `min_separation` [m] or the lower one is not below the upper one, if no ray in air refracts
// into their direction, or if a number is not finite.
std::optional<AirRay> RayOfPair(const ReturnPair& pair, double water_height, double index,
                                double min_separation = 1);

// The middle one of `values`, which are at least one; of an even number the upper one of the two in the middle.
inline double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace albtpu
