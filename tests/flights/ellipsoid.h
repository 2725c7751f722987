// Geodetic and earth-centred coordinates.
#pragma once

#include <Eigen/Core>

namespace albtpu::testing {

struct Ellipsoid {
  double semi_major_axis = 0;  // m
  double inverse_flattening = 0;

  double flattening() const { return 1 / inverse_flattening; }
  double eccentricity_squared() const { return flattening() * (2 - flattening()); }
  // Radii of curvature [m] at `latitude` [rad]: along the meridian, and across it.
  double MeridianRadius(double latitude) const;
  double PrimeVerticalRadius(double latitude) const;
};

// NGA.STND.0036 (2014) and Moritz (2000), table 1: both define these two numbers or derive the second from J2.
inline constexpr Ellipsoid kWgs84{6378137, 298.257223563};
inline constexpr Ellipsoid kGrs80{6378137, 298.257222101};

struct Geodetic {
  double latitude = 0, longitude = 0;  // rad
  double height = 0;                   // m above the ellipsoid
};

// x towards the meridian of Greenwich, z towards the North Pole; m.
Eigen::Vector3d EarthCentred(const Ellipsoid& ellipsoid, const Geodetic& point);

// The inverse, within 1e-9 m (the resolution of a double at 6.4e6 m) below 10 km of height.
Geodetic GeodeticFrom(const Ellipsoid& ellipsoid, const Eigen::Vector3d& point);

// The columns are the directions east, north and up at a point, in earth-centred coordinates.
Eigen::Matrix3d EastNorthUp(double latitude, double longitude);

}  // namespace albtpu::testing
