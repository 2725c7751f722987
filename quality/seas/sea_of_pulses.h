// What a sea does to pulses, and which part of its stated share is that of the heights of its waves.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace albtpu::quality {

// What the sea does to the pulses of one pass: to one of them, and the sum of the covariances of ordered pairs. On the
// axes east, north, up.
struct SeaOfPulses {
  struct Variances {
    Eigen::Matrix3d errors = Eigen::Matrix3d::Zero();  // Per depth^2.
    double height = 0;                                 // Of the water, m^2.
  };
  Variances pulse, pairs;
  // The error of a point where the water lies a metre below where it is taken to be: upwards and back along the beam.
  Eigen::Vector3d by_height = Eigen::Vector3d::UnitZ();
};

// Of the variance of a height over a level bottom, m^2.
struct SeaParts {
  double slopes = 0, heights = 0;
};

// Slopes of waves shift points with the depth, by `pulse.errors` per `squared_depth`. What the variance `stated` of the
// sea has beyond that is the height of unseen waves, of a surface that is not that of the pulse.
inline SeaParts PartsOfSea(double stated, double squared_depth, const SeaOfPulses& sea) {
  const SeaOfPulses::Variances& pulse = sea.pulse;
  const double heights = pulse.height > 0 ? std::max(stated - squared_depth * pulse.errors(2, 2), 0.0) : 0;
  return {.slopes = stated - heights, .heights = heights};
}

// Where the bottom slopes, a point that lies too far back along the beam is also too high or too low: what heights of
// unseen waves do at a fixed place, over what they do on a level bottom. g = (-dz/dx, -dz/dy, 1).
inline double HeightsOnSlope(const Eigen::Vector3d& g, const SeaOfPulses& sea) {
  return g.dot(sea.by_height) / sea.by_height.z();
}

}  // namespace albtpu::quality
