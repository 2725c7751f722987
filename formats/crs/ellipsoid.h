// Metres on the ellipsoid: the lengths of small differences of latitude and longitude on the ground.
#pragma once

#include <cmath>

namespace albtpu::formats {

struct Ellipsoid {
  double semi_major = 6378137.0;                            // m, WGS 84 and GRS 80: exact by definition.
  double eccentricity_squared = 0.00669437999014131699614;  // WGS 84, from 1/f = 298.257223563.

  // Radius of curvature in the meridian, M = a (1 - e^2) / (1 - e^2 sin^2 latitude)^(3/2), m.
  double MeridianRadius(double latitude) const {
    const double w = 1 - eccentricity_squared * std::sin(latitude) * std::sin(latitude);
    return semi_major * (1 - eccentricity_squared) / (w * std::sqrt(w));
  }
  // Radius of curvature in the prime vertical, N = a / sqrt(1 - e^2 sin^2 latitude), m.
  double PrimeVerticalRadius(double latitude) const {
    return semi_major / std::sqrt(1 - eccentricity_squared * std::sin(latitude) * std::sin(latitude));
  }
};

}  // namespace albtpu::formats
