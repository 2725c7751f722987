#include "tests/flights/ellipsoid.h"

#include <cmath>

namespace albtpu::testing {

namespace {

// NGA.STND.0036 (2014), which defines both numbers.
constexpr double kSemiMajorAxis = 6378137, kFlattening = 1 / 298.257223563;
constexpr double kEccentricitySquared = kFlattening * (2 - kFlattening);

}  // namespace

double PrimeVerticalRadius(double latitude) {
  const double sine = std::sin(latitude);
  return kSemiMajorAxis / std::sqrt(1 - kEccentricitySquared * sine * sine);
}

double MeridianRadius(double latitude) {
  const double across = PrimeVerticalRadius(latitude), ratio = across / kSemiMajorAxis;
  return (1 - kEccentricitySquared) * across * ratio * ratio;
}

Eigen::Vector3d EarthCentred(const Geodetic& point) {
  const double radius = PrimeVerticalRadius(point.latitude);
  const double from_axis = (radius + point.height) * std::cos(point.latitude);
  return {from_axis * std::cos(point.longitude), from_axis * std::sin(point.longitude),
          ((1 - kEccentricitySquared) * radius + point.height) * std::sin(point.latitude)};
}

// tan(latitude) = (z + e^2 N sin(latitude)) / p, from the equations above. Each step makes the error smaller by about
// e^2 = 0.0067, and the last one changes nothing but rounding.
Geodetic GeodeticFrom(const Eigen::Vector3d& point) {
  const double p = std::hypot(point.x(), point.y()), e2 = kEccentricitySquared;
  double upward = point.z() / (1 - e2);  // The tangent of the latitude is this over p.
  double length = std::sqrt(upward * upward + p * p), sine = upward / length;
  for (double before = 2 * length; std::abs(upward - before) > 1e-14 * length;) {
    before = upward;
    upward = point.z() + e2 * kSemiMajorAxis * sine / std::sqrt(1 - e2 * sine * sine);
    length = std::sqrt(upward * upward + p * p);
    sine = upward / length;
  }
  // The height is the distance from the ellipsoid's tangent plane, which divides by nothing small.
  const double height = p * (p / length) + point.z() * sine - kSemiMajorAxis * std::sqrt(1 - e2 * sine * sine);
  return {std::atan2(upward, p), std::atan2(point.y(), point.x()), height};
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
