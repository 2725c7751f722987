// A small flight line over a sloping bottom, always the same, for use where no survey is available.
#pragma once

#include "tests/survey/las/las_builder.h"

namespace albtpu::testing {

// The aircraft flies north, 400 m above the water (z = 0), and scans across track, 20 degrees to either side. From a
// beach the bottom slopes to a depth of 18 m. About 24 000 points in UTM metres, of classes 2 ground, 40 bathymetric
// bottom and 41 water surface; each pulse has its GPS time. Formats 0-5, whose classes end at 31, have
// kLegacyBottomClass instead of 40 and 9 instead of 41.
struct SimulatedFlight {
  static constexpr double kWaterLevel = 0;       // m
  static constexpr double kAltitude = 400;       // m
  static constexpr double kFlightDirection = 0;  // degree, true
  static constexpr int kBottomClass = 40;
  static constexpr int kLegacyBottomClass = 26;
};

LasSpec SimulateFlight(int version_minor, int point_format);

}  // namespace albtpu::testing
