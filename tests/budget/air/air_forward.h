// The point that a lidar reports, exactly, in real or complex arithmetic: what the derivatives of budget/air are held
// against.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "budget/air/air_sources.h"
#include "tests/degree.h"

namespace albtpu::testing {

// What may err, in the units of AirErrors, with angles in radians.
enum AirUnknown {
  kNorth,
  kEast,
  kDown,
  kRoll,
  kPitch,
  kHeading,
  kBoresightX,
  kBoresightY,
  kBoresightZ,
  kLeverX,
  kLeverY,
  kLeverZ,
  kScanA,
  kScanB,
  kTime,
  kRangeOffset,
  kBottomRange,
  kSurfaceHeight,
  kIndex,
  kAirUnknowns
};

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

template <typename T>
Eigen::Matrix<T, 3, 3> Turn(int axis, const T& angle) {
  using std::cos;
  using std::sin;
  const T c = cos(angle), s = sin(angle);
  Eigen::Matrix<T, 3, 3> turn = Eigen::Matrix<T, 3, 3>::Zero();
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  turn(axis, axis) = T(1);
  turn(a, a) = turn(b, b) = c;
  turn(b, a) = s;
  turn(a, b) = -s;
  return turn;
}

// The reported point, north, east, down from the point of the trajectory without errors. The optical range is measured,
// and the range to the surface where the lidar located it; processing knows neither `errors`.
template <typename T>
Vector3<T> ReportedPoint(const AirPulse& pulse, bool given, const Eigen::Matrix<T, kAirUnknowns, 1>& errors) {
  using std::sqrt;
  const double incidence = pulse.incidence * kDegree, azimuth = pulse.beam_azimuth * kDegree;
  const Eigen::Matrix3d attitude = Turn<double>(2, pulse.heading * kDegree) * Turn<double>(1, pulse.pitch * kDegree) *
                                   Turn<double>(0, pulse.roll * kDegree);
  // The direction in the scanner, without errors.
  const Eigen::Vector3d u0(std::sin(incidence) * std::cos(azimuth), std::sin(incidence) * std::sin(azimuth),
                           std::cos(incidence));
  const Eigen::Vector3d a0(std::cos(incidence) * std::cos(azimuth), std::cos(incidence) * std::sin(azimuth),
                           -std::sin(incidence));
  const Eigen::Vector3d b0(-std::sin(azimuth), std::cos(azimuth), 0);
  const Vector3<T> scanned = u0.cast<T>() + a0.cast<T>() * errors[kScanA] + b0.cast<T>() * errors[kScanB];
  const T length = sqrt(scanned.cwiseProduct(scanned).sum());  // The norm of complex vectors is not analytic.
  const Vector3<T> in_aircraft = attitude.transpose().cast<T>() * (scanned / length);
  const Eigen::Matrix<T, 3, 3> boresight =
      Turn<T>(2, errors[kBoresightZ]) * Turn<T>(1, errors[kBoresightY]) * Turn<T>(0, errors[kBoresightX]);
  // The laser's time is late by errors[kTime]: the aircraft has moved and turned.
  const T t = errors[kTime];
  const Vector3<T> turned = (pulse.rates * kDegree).cast<T>() * t;
  Eigen::Matrix<T, 3, 3> spin = Eigen::Matrix<T, 3, 3>::Identity();
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    spin(c, b) += turned[a];
    spin(b, c) -= turned[a];
  }
  const Eigen::Matrix<T, 3, 3> by_angles = Turn<T>(2, T(pulse.heading * kDegree) + errors[kHeading]) *
                                           Turn<T>(1, T(pulse.pitch * kDegree) + errors[kPitch]) *
                                           Turn<T>(0, T(pulse.roll * kDegree) + errors[kRoll]) * spin;
  const Vector3<T> lever = pulse.lever_arm.cast<T>() + Vector3<T>(errors[kLeverX], errors[kLeverY], errors[kLeverZ]);
  Vector3<T> sensor = by_angles * lever + pulse.velocity.cast<T>() * t;
  sensor += Vector3<T>(errors[kNorth], errors[kEast], errors[kDown]);
  const Vector3<T> u = by_angles * (boresight * in_aircraft);

  const Eigen::Vector3d sensor0 = attitude * pulse.lever_arm;
  const double slant = pulse.altitude / u0.z();
  const double down0 = std::sqrt(1 - (u0.x() * u0.x() + u0.y() * u0.y()) / (pulse.index * pulse.index));
  const double optical = slant + pulse.index * pulse.depth / down0;
  const double surface_down = sensor0.z() + pulse.altitude;
  const T n = T(pulse.index) + errors[kIndex];
  const T ranged = T(optical) + errors[kRangeOffset] + errors[kBottomRange];
  // An error of the height upwards shortens the way to a surface given; of the own return, the range is by that
  // shorter.
  T in_air = T(slant) + errors[kRangeOffset] - errors[kSurfaceHeight] / u[2];
  if (given) in_air = (T(surface_down) - errors[kSurfaceHeight] - sensor[2]) / u[2];
  const T in_water = (ranged - in_air) / n;
  const T wn = u[0] / n, we = u[1] / n;
  const Vector3<T> w(wn, we, sqrt(T(1) - wn * wn - we * we));
  return sensor + u * in_air + w * in_water;
}

// Any pulse that a survey might send.
inline AirPulse RandomPulse(std::mt19937& random) {
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  const auto vector = [&](double most) {
    return Eigen::Vector3d(between(-most, most), between(-most, most), between(-most, most));
  };
  return {.incidence = between(0, 35),
          .beam_azimuth = between(0, 360),
          .altitude = between(100, 1000),
          .depth = between(0, 60),
          .roll = between(-30, 30),
          .pitch = between(-20, 20),
          .heading = between(-180, 360),
          .velocity = vector(80),
          .rates = vector(6),
          .lever_arm = vector(2),
          .index = between(1, 1.36)};
}

}  // namespace albtpu::testing
