// The standard deviations that a sensor file and [sigma] of a survey file state: their keys, units and ranges. A range
// is wide; it is there to catch a number in another unit.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "config/toml/toml_keys.h"

namespace albtpu::client {

using config::TomlKeys;

struct SigmaRange {
  std::string_view key, unit;
  double greatest;
  std::string_view parts = {};  // Of those that are three numbers.
};

namespace sigma {

inline constexpr SigmaRange kPosition = {"position", "m", 100, "[north, east, down]"};
inline constexpr SigmaRange kAttitude = {"attitude", "degree", 10, "[roll, pitch, heading]"};
inline constexpr SigmaRange kBoresight = {"boresight", "degree", 10, "[x, y, z]"};
inline constexpr SigmaRange kLeverArm = {"lever_arm", "m", 10};  // Each axis.
inline constexpr SigmaRange kScan = {"scan", "degree", 5};       // Each of two angles.
inline constexpr SigmaRange kTime = {"time", "s", 1};            // Of the scanner against the trajectory.
inline constexpr SigmaRange kRangeOffset = {"range_offset", "m", 10};      // The same for all pulses.
inline constexpr SigmaRange kBottomRange = {"bottom_range", "m", 10};      // Optical, to the bottom.
inline constexpr SigmaRange kSurfaceRange = {"surface_range", "m", 10};    // To the surface of the water.
inline constexpr SigmaRange kSurfaceHeight = {"surface_height", "m", 10};  // Of the surface of the water.
inline constexpr SigmaRange kIndex = {"index", "1", 0.1};                  // Of refraction.

}  // namespace sigma

// Degree. The best of airborne systems know roll and pitch to 0.0025 degrees, which are 4.4e-5 rad. An angle between 0
// and this was meant in radians.
inline constexpr double kLeastAngle = 2e-4;

// The standard deviation, or three of them, under `key`; 0 is none. Absent if the key is missing or a problem.
std::optional<double> ReadSigma(TomlKeys& keys, std::string_view key, const SigmaRange& range);
std::optional<std::array<double, 3>> ReadSigmas(TomlKeys& keys, std::string_view key,
                                                const SigmaRange& range);

}  // namespace albtpu::client
