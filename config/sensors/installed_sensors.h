// The sensors that are installed, and those in files of the user.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "config/sensors/sensor.h"

namespace albtpu::config {

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
