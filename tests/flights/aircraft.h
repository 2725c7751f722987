// An aircraft on a survey line: where it is and how it is turned, as smooth functions of time, and where its scanner
// points.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

#include "tests/flights/ellipsoid.h"
#include "tests/flights/smooth_motion.h"

namespace albtpu::testing {

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
