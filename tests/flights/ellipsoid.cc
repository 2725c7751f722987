#include "tests/flights/ellipsoid.h"

#include <cmath>

namespace albtpu::testing {

double Ellipsoid::PrimeVerticalRadius(double latitude) const {
  const double sine = std::sin(latitude);
  return semi_major_axis / std::sqrt(1 - eccentricity_squared() * sine * sine);
}

double Ellipsoid::MeridianRadius(double latitude) const {
  const double across = PrimeVerticalRadius(latitude), ratio = across / semi_major_axis;
  return (1 - eccentricity_squared()) * across * ratio * ratio;
}

Eigen::Vector3d EarthCentred(const Ellipsoid& ellipsoid, const Geodetic& point) {
  const double radius = ellipsoid.PrimeVerticalRadius(point.latitude);
  const double from_axis = (radius + point.height) * std::cos(point.latitude);
  return {from_axis * std::cos(point.longitude), from_axis * std::sin(point.longitude),
          ((1 - ellipsoid.eccentricity_squared()) * radius + point.height) * std::sin(point.latitude)};
}

// tan(latitude) = (z + e^2 N sin(latitude)) / p, from the equations above. Each step makes the error smaller by about
// e^2 = 0.0067, and the last one changes nothing but rounding.
Geodetic GeodeticFrom(const Ellipsoid& ellipsoid, const Eigen::Vector3d& point) {
  const double from_axis = std::hypot(point.x(), point.y()), e2 = ellipsoid.eccentricity_squared();
  double latitude = std::atan2(point.z(), from_axis * (1 - e2));
  for (double before = 2; std::abs(latitude - before) > 1e-14;) {
    before = latitude;
    latitude = std::atan2(point.z() + e2 * ellipsoid.PrimeVerticalRadius(latitude) * std::sin(latitude), from_axis);
  }
  // The height is the distance from the ellipsoid's tangent plane, which divides by nothing small.
  const double cosine = std::cos(latitude), sine = std::sin(latitude);
  const double ratio = ellipsoid.semi_major_axis / ellipsoid.PrimeVerticalRadius(latitude);
  const double height = from_axis * cosine + point.z() * sine - ellipsoid.semi_major_axis * ratio;
  return {latitude, std::atan2(point.y(), point.x()), height};
}

Eigen::Matrix3d EastNorthUp(double latitude, double longitude) {
  const double sin_lat = std::sin(latitude), cos_lat = std::cos(latitude);
  const double sin_lon = std::sin(longitude), cos_lon = std::cos(longitude);
  Eigen::Matrix3d axes;
  axes << -sin_lon, -sin_lat * cos_lon, cos_lat * cos_lon,  //
      cos_lon, -sin_lat * sin_lon, cos_lat * sin_lon,       //
      0, cos_lat, sin_lat;
  return axes;
}

}  // namespace albtpu::testing
