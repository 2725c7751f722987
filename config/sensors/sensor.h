// A sensor: how well it measures, each number with its source; the numbers that the sources of error may have in files
// of TOML, and the sensors that are installed. The file of a sensor has one number a table:
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
//     [surface_channel]
//     value = "green"                     # the laser that can locate the water surface; "infrared" where it has one
//     source = "..."
//
// Tables of numbers are the sources of error that a sensor may state (budget/air/air_errors.h), standard deviations of
// which some are a list of three; and the divergence. What is not published is absent.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "budget/air/air_errors.h"
#include "config/toml/toml_keys.h"

namespace albtpu::config {

// Standard deviations of the sources of error (budget/air/air_errors.h) as TOML states them: in a sensor file and under
// [sigma] of a survey file.

// Those of some sources; of the others, `values` says nothing.
struct StatedErrors {
  AirErrors values;
  std::array<bool, kErrorSourceCount> stated = {};  // In the order of kErrorSources.

  bool any() const { return std::ranges::find(stated, true) != stated.end(); }
  template <typename Member>
  bool Has(Member AirErrors::*source) const {
    return stated[Index(source)];
  }
};

// "[north, east, down]", of a source with three numbers.
std::string PartsText(const ErrorSource& source);

// Degree. The best of airborne systems know roll and pitch to 0.0025 degrees, which are 4.4e-5 rad. An angle between 0
// and this was meant in radians.
inline constexpr double kLeastAngle = 2e-4;

// Reads what `key` has of source `i` of kErrorSources: its number or its three numbers, each from 0 to the greatest
// plausible; 0 is none. Not stated if the key is missing or a problem.
void ReadErrors(config::TomlKeys& keys, std::string_view key, std::size_t i, StatedErrors& errors);

struct SourcedDivergence {
  double value = 0;                       // mrad, full angle
  std::optional<double> least, greatest;  // where it is variable
  std::string source;
};

// The lasers whose returns can locate the water surface: a green one, which finds it too low (green_surface.h).
inline constexpr std::array<std::string_view, 2> kSurfaceChannels = {"green", "infrared"};

struct SourcedChannel {
  std::string value;  // One of kSurfaceChannels: "green" of a sensor without an infrared laser.
  std::string source;
};

struct Sensor {
  std::string name;   // The file's, without .toml; empty for a text that is no file.
  std::string title;  // As people call it.
  std::string path;
  StatedErrors errors;
  std::array<std::string, kErrorSourceCount> origins;  // Where each stated number is from; empty for the others.
  std::optional<SourcedDivergence> divergence;
  std::optional<SourcedChannel> surface_channel;
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

// The sensors that are installed, and those in files of the user.

// The value of the environment variable `ALBTPU_SENSORS`. If it is empty or not set, PREFIX/share/albtpu/sensors for a
// program that runs as PREFIX/bin/NAME. The folder need not exist.
std::filesystem::path SensorsDirectory();

// All installed sensors, by name. Empty if the folder does not exist; fails on a file that is wrong.
absl::StatusOr<std::vector<Sensor>> ListSensors();

// Whether a sensor is named by the path of its file: it ends in .toml or has a slash.
bool IsSensorFile(std::string_view name);

// The installed sensor of a name, or the sensor in a file. NotFound with the names that there are.
absl::StatusOr<Sensor> FindSensor(std::string_view name_or_path);

}  // namespace albtpu::config
