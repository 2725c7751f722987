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
// The tables are the sources of error that a sensor may state (budget/air/air_errors.h): standard deviations, of which
// some are a list of three; and the divergence. What nobody publishes is absent.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "config/sensors/stated_errors.h"

namespace albtpu::config {

struct SourcedDivergence {
  double value = 0;                       // mrad, full angle
  std::optional<double> least, greatest;  // where it is variable
  std::string source;
};

struct Sensor {
  std::string name;   // The file's, without .toml; empty for a text that is no file.
  std::string title;  // As people call it.
  std::string path;
  StatedErrors errors;
  std::array<std::string, kErrorSourceCount>
      origins;  // Where each stated number is from; empty for the others.
  std::optional<SourcedDivergence> divergence;
};

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

}  // namespace albtpu::config
