// The waves of a wind as they travel, and what they are said to do to pulses.
#pragma once

#include <Eigen/Core>

#include "quality/seas/seas_of_files.h"
#include "tests/flights/aircraft.h"

namespace albtpu::testing {

inline constexpr double kSeaFootprint = 0.5;  // m

// Fully developed, of Elfouhaily's spectrum, from the west.
quality::SeaOfSource SeaOfWind(double wind_speed);

// The covariance of the slopes that a footprint of kSeaFootprint averages, along the wind and across it.
Eigen::Matrix2d SlopesUnderFootprint(double wind_speed);

// The standard deviation of the heights under such a footprint, m.
double SigmaOfHeights(double wind_speed);

// One realization: waves of every length and direction, drawn with their phases. Of no covariance of two pulses.
class TravellingSea {
 public:
  TravellingSea(double wind_speed, RandomNumbers& random);

  // The slope under a footprint, to the east and to the north, and the height, m.
  struct Water {
    Eigen::Vector2d slope;
    double height;
  };
  Water At(double x, double y, double time) const;

 private:
  Eigen::ArrayXf kx_, ky_, omega_, phase_, height_;
};

}  // namespace albtpu::testing
