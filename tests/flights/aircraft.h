// An aircraft on a survey line: where it is and how it is turned, as smooth functions of time, and where its scanner
// points.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "tests/flights/ellipsoid.h"

namespace albtpu::testing {

// Uniform random numbers that are the same on every machine: splitmix64 (Steele et al. 2014,
// doi:10.1145/2714064.2660195).
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : state_(seed) {}

  double Uniform(double low, double high);
  double Normal();  // Mean 0, variance 1.

 private:
  std::uint64_t state_;
};

// mean + sum of amplitude sin(frequency t + phase), with the derivative.
class SmoothMotion {
 public:
  struct Sinusoid {
    double amplitude = 0, frequency = 0, phase = 0;  // any unit, rad/s, rad
  };

  // `terms` sinusoids with frequencies between the two [rad/s] and a standard deviation of `sigma` over long times.
  SmoothMotion(double mean, double sigma, double lowest, double highest, int terms, RandomNumbers& random);

  // The same and more sinusoids, such as turbulence on a slow drift.
  SmoothMotion Plus(const SmoothMotion& other) const;

  double At(double time) const;
  double RateAt(double time) const;  // per second

 private:
  double mean_ = 0;
  std::vector<Sinusoid> sinusoids_;
};

enum class ScannerKind {
  kCone,     // 20 degrees from nadir in every direction: a Palmer scanner.
  kEllipse,  // 20 degrees across track, 14 along.
  kRaster,   // 20 degrees to either side, across track only.
};

// "palmer" (or "cone"), "ellipse", "raster".
std::optional<ScannerKind> FindScanner(std::string_view name);

// Unit vector (forward, right, down) at `turns`, the number of periods of the scanner since the beginning.
Eigen::Vector3d BeamDirection(ScannerKind kind, double turns);

// The columns are the body axes (forward, right, down), on the axes north, east and down: turned by roll about the
// forward axis, then by pitch about the right, then by heading about the down axis; rad. Of a scanner in the body, too.
Eigen::Matrix3d Attitude(const Eigen::Vector3d& roll_pitch_heading);

// A plane chart of the survey area: metres east and north of an origin that are proportional to longitude and latitude.
// It places aircraft and seabed; no distance is measured in it.
class AreaChart {
 public:
  AreaChart(double latitude, double longitude);

  Geodetic At(double east, double north, double height) const;
  Eigen::Vector2d EastNorth(const Geodetic& point) const;
  double metres_per_latitude() const { return metres_per_latitude_; }    // Per radian.
  double metres_per_longitude() const { return metres_per_longitude_; }  // Per radian.

 private:
  double latitude_, longitude_;
  double metres_per_latitude_, metres_per_longitude_;
};

// The state of the reference point of the navigation system.
struct AircraftState {
  Geodetic position;
  Eigen::Vector3d velocity;  // m/s: north, east, up
  double roll = 0;           // rad, right side down positive
  double pitch = 0;          // rad, nose up positive
  double heading = 0;        // rad, of the nose, clockwise from true north

  // The columns are the body axes (forward, right, down) in earth-centred coordinates.
  Eigen::Matrix3d BodyAxes() const;
};

// A straight line, left by metres and degrees in the smooth random way of real flight. The course differs from the
// heading by the crab angle.
class Aircraft {
 public:
  struct Options {
    double east = 0, north = 0;  // m in the chart, where the line begins
    double course = 0;           // rad, clockwise from north in the chart
    double height = 0;           // m above the ellipsoid
    double speed = 60;           // m/s
    double crab_angle = 0;       // rad
    double drift = 1;            // The motion around the straight line, relative to the usual.
  };

  Aircraft(const AreaChart& chart, const Options& options, RandomNumbers& random);

  // `time` in s since the beginning of the line; any sign.
  AircraftState At(double time) const;

  // m east and north in the chart, and above the ellipsoid.
  Eigen::Vector3d InChart(double time) const;
  // rad: roll, pitch and heading.
  Eigen::Vector3d Angles(double time) const { return {roll_.At(time), pitch_.At(time), heading_.At(time)}; }

 private:
  AreaChart chart_;
  Options options_;
  SmoothMotion along_, across_, height_, roll_, pitch_, heading_;
};

}  // namespace albtpu::testing
