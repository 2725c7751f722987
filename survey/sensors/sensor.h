// A sensor: how well it measures, each number with its source. A file of TOML, one number a table:
//
//     title = "RIEGL VQ-880-G"
//     [scan]
//     value = 0.02                        # 1 sigma
//     unit = "degree"
//     source = "cBLUE 4.2, lidar_sensors.json"
//     [divergence]
//     value = 1                           # full angle; of a beam that varies, what is taken where nothing is said
//     least = 0.7
//     greatest = 2
//     unit = "mrad"
//     source = "..."
//
// Numbers are standard deviations, but for the divergence; three are [position], [attitude] and [boresight], whose
// value is a list. What no source gives is absent.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "survey/sensors/sigma_range.h"

namespace albtpu::client {

struct SourcedNumber {
  double value = 0;
  std::string source;
};
struct SourcedTriple {
  std::array<double, 3> value{};
  std::string source;
};
struct SourcedDivergence {
  double value = 0;                       // mrad, full angle
  std::optional<double> least, greatest;  // where it is variable
  std::string source;
};

// Units and meanings as in survey/sensors/sigma_range.h.
struct Sensor {
  std::string name;   // The file's, without .toml; empty for a text that is no file.
  std::string title;  // As people call it.
  std::string path;
  std::optional<SourcedNumber> scan, bottom_range, surface_range, range_offset, lever_arm, time;
  std::optional<SourcedTriple> position, attitude, boresight;
  std::optional<SourcedDivergence> divergence;
};

template <typename Sourced>
struct SensorKey {
  SigmaRange range;
  std::optional<Sourced> Sensor::*field;
};
inline constexpr std::array<SensorKey<SourcedNumber>, 6> kSensorNumbers = {{
    {sigma::kScan, &Sensor::scan},
    {sigma::kBottomRange, &Sensor::bottom_range},
    {sigma::kSurfaceRange, &Sensor::surface_range},
    {sigma::kRangeOffset, &Sensor::range_offset},
    {sigma::kLeverArm, &Sensor::lever_arm},
    {sigma::kTime, &Sensor::time},
}};
inline constexpr std::array<SensorKey<SourcedTriple>, 3> kSensorTriples = {{
    {sigma::kPosition, &Sensor::position},
    {sigma::kAttitude, &Sensor::attitude},
    {sigma::kBoresight, &Sensor::boresight},
}};

// mrad, full angle. A green beam of less would leave the aircraft with a diameter of 3.4 cm or more (4 lambda/(pi D));
// it was meant in radians.
inline constexpr double kLeastDivergence = 0.02, kGreatestDivergence = 100;

// InvalidArgument "line 3: ..." at the first problem: a number without its source or its unit, a key that is unknown,
// of another type or out of range.
absl::StatusOr<Sensor> ParseSensor(std::string_view text);

// The same of a file, whose path begins the message.
absl::StatusOr<Sensor> ReadSensor(const std::filesystem::path& path);

// The keys of the numbers that no source gives.
std::vector<std::string> UnknownOf(const Sensor& sensor);

}  // namespace albtpu::client
