// The files of a simulated survey: its points as LAS, what is true of each of them, and its trajectory in the formats
// that surveys have.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/flights/survey.h"
#include "tests/formats/las/las_builder.h"

namespace albtpu::testing {

struct PointOptions {
  int version_minor = 4, point_format = 6;
  bool adjusted_time = true;  // GPS time - 1e9 s; otherwise seconds of the GPS week.
  int gps_week = 2200;
  double geoid_separation = 0;  // m; heights in the LAS file are ellipsoidal heights less this.
  double divergence = 1.0;      // mrad, for the footprints of the truth
  double scale = 0.001;         // Units of the grid.
  bool geotiff_keys = false;    // The coordinate system as GeoTIFF keys instead of well-known text.
  bool no_source_id = false;    // All points have the line number 0.
};

// Returns of the survey by index, as the points of one LAS file.
LasSpec PointsOf(const SimulatedSurvey& survey, const std::vector<std::size_t>& returns, const PointOptions& options);

// For each of the same points kTruthColumns little-endian doubles. Angles are degrees, azimuths from 0 to 360.
inline constexpr const char* kTruthColumns[] = {
    "time",                      // s of the GPS week in which the survey begins
    "line",                      // from 1
    "pulse",                     // from 0
    "kind",                      // 0 bottom, 1 water surface, 2 water column, 3 land
    "incidence",                 // degree, in air, from the vertical at the water
    "beam_azimuth",              // degree from true north
    "footprint",                 // m: slant range times divergence
    "water_depth",               // m under the mean water; 0 on land
    "slant_range",               // m, in air
    "sensor_x",     "sensor_y",  // units of the grid
    "sensor_z",                  // m, in the vertical datum of the LAS file
    "convergence",               // degree, true azimuth of grid north at the sensor
    "scale",                     // m on the map for a metre on the ellipsoid
};
std::string TruthOf(const SimulatedSurvey& survey, const std::vector<std::size_t>& returns,
                    const PointOptions& options);

struct TrajectoryOptions {
  double rate = 200;              // Hz
  double error_rate = 2;          // Hz, of SMRMSG
  double margin = 3;              // s before and after each line
  double wander = 0.349;          // rad; the wander angle where the survey begins
  double gap_start = 0, gap = 0;  // s since the beginning of the first line; length in s: no records inside
  double clock = 0;               // s, added to all times: -18 for UTC
};

// As Applanix's POSPac writes them: records of 17 and of 10 little-endian doubles without a header. PDAL's readers.sbet
// and readers.smrmsg document both.
std::string SbetFile(const SimulatedSurvey& survey, const TrajectoryOptions& options);
std::string SmrmsgFile(const SimulatedSurvey& survey, const TrajectoryOptions& options);

// Lines of t lon lat X Y Z roll pitch heading sigma_X sigma_Y sigma_Z sigma_roll sigma_pitch sigma_heading: degrees,
// metres of the grid's projection (0 if there is none), and metres above the ellipsoid.
std::string AsciiTrajectory(const SimulatedSurvey& survey, const TrajectoryOptions& options);

}  // namespace albtpu::testing
