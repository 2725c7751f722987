// The trajectory of a simulated survey in the formats that surveys have.
//
// SBET and SMRMSG as Applanix's POSPac writes them: records of 17 and of 10 little-endian doubles without a header.
// PDAL's readers.sbet and readers.smrmsg document both.
#pragma once

#include <string>

#include "tests/flights/survey.h"

namespace albtpu::testing {

struct TrajectoryOptions {
  double rate = 200;              // Hz
  double error_rate = 2;          // Hz, of SMRMSG
  double margin = 3;              // s before and after each line
  double wander = 0.349;          // rad; the wander angle where the survey begins
  double gap_start = 0, gap = 0;  // s since the beginning of the first line; length in s: no records inside
  double clock = 0;               // s, added to all times: -18 for UTC
};

std::string SbetFile(const SimulatedSurvey& survey, const TrajectoryOptions& options);
std::string SmrmsgFile(const SimulatedSurvey& survey, const TrajectoryOptions& options);

// Lines of t lon lat X Y Z roll pitch heading sigma_X sigma_Y sigma_Z sigma_roll sigma_pitch sigma_heading: degrees,
// metres of the grid's projection (0 if there is none), and metres above the ellipsoid.
std::string AsciiTrajectory(const SimulatedSurvey& survey, const TrajectoryOptions& options);

}  // namespace albtpu::testing
