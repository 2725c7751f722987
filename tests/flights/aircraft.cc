#include "tests/flights/aircraft.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace albtpu::testing {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

AreaChart::AreaChart(double latitude, double longitude)
    : latitude_(latitude),
      longitude_(longitude),
      metres_per_latitude_(kWgs84.MeridianRadius(latitude)),
      metres_per_longitude_(kWgs84.PrimeVerticalRadius(latitude) * std::cos(latitude)) {}

Geodetic AreaChart::At(double east, double north, double height) const {
  return {latitude_ + north / metres_per_latitude_, longitude_ + east / metres_per_longitude_, height};
}

Eigen::Vector2d AreaChart::EastNorth(const Geodetic& point) const {
  return {(point.longitude - longitude_) * metres_per_longitude_, (point.latitude - latitude_) * metres_per_latitude_};
}

// From body to north, east, down: roll about the forward axis, then pitch about the right, then heading about the down
// axis. The directions of north, east and down come from EastNorthUp.
Eigen::Matrix3d AircraftState::BodyAxes() const {
  const Eigen::Matrix3d east_north_up = EastNorthUp(position.latitude, position.longitude);
  Eigen::Matrix3d north_east_down;
  north_east_down << east_north_up.col(1), east_north_up.col(0), -east_north_up.col(2);
  return north_east_down *
         (Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
             .toRotationMatrix();
}

// Amplitudes of a twin-engined aircraft in light turbulence: 1 m/s of speed, metres of drift and height over tens of
// seconds, a few centimetres within seconds; degrees of attitude.
Aircraft::Aircraft(const AreaChart& chart, const Options& options, RandomNumbers& random)
    : chart_(chart),
      options_(options),
      along_(SmoothMotion(0, 6, 0.05, 0.2, 4, random).Plus({0, 0.03, 0.5, 2, 4, random})),
      across_(SmoothMotion(0, 5, 0.05, 0.2, 4, random).Plus({0, 0.05, 0.5, 2, 4, random})),
      height_(SmoothMotion(options.height, 3, 0.05, 0.3, 4, random).Plus({0, 0.05, 0.5, 2, 4, random})),
      roll_(SmoothMotion(0, 1.5 * kDegree, 0.1, 0.6, 4, random).Plus({0, 0.4 * kDegree, 0.6, 4, 4, random})),
      pitch_(SmoothMotion(2 * kDegree, kDegree, 0.1, 0.6, 4, random).Plus({0, 0.2 * kDegree, 0.6, 4, 4, random})),
      heading_(SmoothMotion(options.course + options.crab_angle, kDegree, 0.05, 0.4, 4, random)
                   .Plus({0, 0.2 * kDegree, 0.4, 3, 4, random})) {}

AircraftState Aircraft::At(double time) const {
  const double sine = std::sin(options_.course), cosine = std::cos(options_.course);
  const double along = options_.speed * time + along_.At(time), across = across_.At(time);
  const double along_rate = options_.speed + along_.RateAt(time), across_rate = across_.RateAt(time);
  AircraftState state;
  state.position = chart_.At(options_.east + along * sine + across * cosine,
                             options_.north + along * cosine - across * sine, height_.At(time));
  // The chart's metres are not those of the ellipsoid away from its origin, nor those of the aircraft's height.
  const Geodetic& here = state.position;
  const double true_north = (kWgs84.MeridianRadius(here.latitude) + here.height) / chart_.metres_per_latitude();
  const double true_east = (kWgs84.PrimeVerticalRadius(here.latitude) + here.height) * std::cos(here.latitude) /
                           chart_.metres_per_longitude();
  state.velocity = {(along_rate * cosine - across_rate * sine) * true_north,
                    (along_rate * sine + across_rate * cosine) * true_east, height_.RateAt(time)};
  state.roll = roll_.At(time);
  state.pitch = pitch_.At(time);
  state.heading = heading_.At(time);
  return state;
}

}  // namespace albtpu::testing
