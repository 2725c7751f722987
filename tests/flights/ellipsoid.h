// Geodetic and earth-centred coordinates of WGS 84.
#pragma once

#include <Eigen/Core>
#include <numbers>

#include "tests/degree.h"

namespace albtpu::testing {

// Radii of curvature of the ellipsoid [m] at `latitude` [rad]: along the meridian, and across it.
double MeridianRadius(double latitude);
double PrimeVerticalRadius(double latitude);

struct Geodetic {
  double latitude = 0, longitude = 0;  // rad
  double height = 0;                   // m above the ellipsoid
};

// x towards the meridian of Greenwich, z towards the North Pole; m.
Eigen::Vector3d EarthCentred(const Geodetic& point);

// The inverse, within 1e-9 m (the resolution of a double at 6.4e6 m) below 10 km of height.
Geodetic GeodeticFrom(const Eigen::Vector3d& point);

// The columns are the directions east, north and up at a point, in earth-centred coordinates.
Eigen::Matrix3d EastNorthUp(double latitude, double longitude);

}  // namespace albtpu::testing
