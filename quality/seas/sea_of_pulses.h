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
};

// Of the variance of a height, m^2.
struct SeaParts {
  double slopes = 0, heights = 0;
};

// Slopes of waves shift points with the depth, by `pulse.errors` per `squared_depth`. What the variance `stated` of the
// sea has beyond that is the height of unseen waves, of a surface that is not that of the pulse.
inline SeaParts PartsOfSea(double stated, double squared_depth, const SeaOfPulses::Variances& pulse) {
  const double heights = pulse.height > 0 ? std::max(stated - squared_depth * pulse.errors(2, 2), 0.0) : 0;
  return {.slopes = stated - heights, .heights = heights};
}

}  // namespace albtpu::quality
