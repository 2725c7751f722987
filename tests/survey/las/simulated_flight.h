// A small flight line over a sloping bottom, the same every time: where no survey is at hand.
#pragma once

#include "tests/survey/las/las_builder.h"

namespace albtpu::testing {

// The aircraft flies north, 400 m above the water (z = 0), and scans across track, 20 degrees to either side.
// From a beach the bottom falls to 18 m. Classes: 2 ground, 40 bathymetric bottom, 41 water surface. Some 24
// 000 points, in UTM metres. `legacy_class` takes the place of 40 in formats 0-5, whose classes end at 31.
struct SimulatedFlight {
  static constexpr double kWaterLevel = 0;       // m
  static constexpr double kAltitude = 400;       // m
  static constexpr double kFlightDirection = 0;  // degree, true
  static constexpr int kBottomClass = 40;
  static constexpr int kLegacyBottomClass = 26;
};

LasSpec SimulateFlight(int version_minor, int point_format);

}  // namespace albtpu::testing
