// A simulated survey: what the scanner, the aircraft and the water do, pulse by pulse, and the returns of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/flights/aircraft.h"
#include "tests/flights/map_grid.h"
#include "tests/flights/reported_points.h"

namespace albtpu::testing {

struct SurveyOptions {
  ScannerKind scanner = ScannerKind::kCone;
  std::uint64_t seed = 1;
  std::string grid = "utm17n";
  double latitude = 0.4712, longitude = -1.3980;         // rad; the origin of the first line: 27.0 N, 80.1 W.
  double start = 320000;                                 // s of the GPS week
  double seconds = 30;                                   // of each line
  int lines = 1;                                         // Side by side and to and fro, a minute apart.
  int cross_lines = 0;                                   // After these, across them.
  double course = 0.61;                                  // rad, of the first line
  double altitude = 400;                                 // m above the water
  double speed = 60;                                     // m/s
  double crab_angle = 0.087;                             // rad
  double pulse_rate = 1000, scan_rate = 17.3;            // Hz
  Eigen::Vector3d lever_arm{0.3, -0.2, 0.5};             // m: forward, right, down from reference point to laser
  Eigen::Vector3d boresight{0.00175, -0.00087, 0.0035};  // rad: roll, pitch and heading of the scanner in the body
  double water_level = -25;                              // m above the ellipsoid
  double wave_height = 0;                                // m, significant
  double range_noise = 0;                                // m, one sigma, along the beam
  double column_share = 0.2;                             // Of the pulses over water: with a second return under water.
  double surface_share = 0.3;                            // With a return of the surface.
  ReportingErrors errors;                                // With any, range_noise is that of optical ranges.
};

enum class ReturnKind : std::uint8_t { kBottom, kSurface, kColumn, kLand };

struct SimulatedPulse {
  double time = 0;  // s of the GPS week; beyond 604800 in the week that follows
  int line = 0;     // from 1
  Geodetic sensor;
  double incidence = 0, azimuth = 0;  // rad
  double slant_range = 0;             // m, in air
  double scan_angle = 0;              // rad across track, right positive, roll included: what LAS files have
};

struct SimulatedReturn {
  std::size_t pulse = 0;  // Index in the survey.
  ReturnKind kind = ReturnKind::kBottom;
  int number = 1, count = 1;  // Of the returns of the pulse, from above.
  Geodetic position;          // As delivered: with the noise of its range.
  double depth = 0;           // m under the mean water, without noise; 0 on land
};

struct SimulatedSurvey {
  SurveyOptions options;
  std::vector<Aircraft> aircraft = {};  // One for each line.
  std::vector<SimulatedPulse> pulses = {};
  std::vector<SimulatedReturn> returns = {};  // In the order of time.

  int lines() const { return options.lines + options.cross_lines; }
  double LineStart(int line) const;  // s of the GPS week; `line` from 0
};

SimulatedSurvey Simulate(const SurveyOptions& options);

}  // namespace albtpu::testing
