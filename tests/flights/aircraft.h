// An aircraft on a survey line: where it is and how it is turned, as smooth functions of time.
#pragma once

#include <Eigen/Core>

#include "tests/flights/ellipsoid.h"
#include "tests/flights/smooth_motion.h"

namespace albtpu::testing {

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
  };

  Aircraft(const AreaChart& chart, const Options& options, RandomNumbers& random);

  // `time` in s since the beginning of the line; any sign.
  AircraftState At(double time) const;

 private:
  AreaChart chart_;
  Options options_;
  SmoothMotion along_, across_, height_, roll_, pitch_, heading_;
};

}  // namespace albtpu::testing
