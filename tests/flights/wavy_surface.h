// Waves on the water: heights and slopes as a sum of sinusoids.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/flights/smooth_motion.h"

namespace albtpu::testing {

// Wind waves of the significant height `height` [m], travelling within 60 degrees of the direction `towards` [rad from
// north]. The peak is at 10 m (a period of 2.5 s); the shortest that tilt a footprint of half a metre as a whole are
// 1 m. The spectrum of elevation is k^-3 exp(-1.25 (k_p/k)^2) between (Phillips 1958; Pierson and Moskowitz 1964), so
// that Hs 0.3 m has a slope of 0.104 rms. Height 0: flat.
class WavySurface {
 public:
  WavySurface(double height, double towards, RandomNumbers& random);

  struct Local {
    double elevation = 0;                             // m
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();  // towards east, north
  };
  Local At(const Eigen::Vector2d& east_north, double time) const;

 private:
  struct Wave {
    double amplitude;            // m
    Eigen::Vector2d wavenumber;  // rad/m, east and north
    double frequency, phase;     // rad/s, rad
  };
  std::vector<Wave> waves_;
};

}  // namespace albtpu::testing
