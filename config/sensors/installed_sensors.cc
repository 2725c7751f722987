#include "config/sensors/installed_sensors.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "formats/text/near_match.h"
#include "formats/text/one_line.h"
#include "tables/default_tables.h"

namespace albtpu::config {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> InstalledNames() {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(SensorsDirectory(), error))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

fs::path PathOf(const std::string& name) { return SensorsDirectory() / (name + ".toml"); }

}  // namespace

fs::path SensorsDirectory() {
  if (const char* folder = std::getenv("ALBTPU_SENSORS"); folder != nullptr && *folder != '\0') return folder;
  return InstalledDataDirectory() / "sensors";
}

absl::StatusOr<std::vector<Sensor>> ListSensors() {
  std::vector<Sensor> sensors;
  for (const std::string& name : InstalledNames()) {
    absl::StatusOr<Sensor> sensor = ReadSensor(PathOf(name));
    if (!sensor.ok()) return sensor.status();
    sensors.push_back(*std::move(sensor));
  }
  return sensors;
}

bool IsSensorFile(std::string_view name) {
  return name.ends_with(".toml") || name.find('/') != std::string_view::npos;
}

absl::StatusOr<Sensor> FindSensor(std::string_view name_or_path) {
  const std::string name(name_or_path);
  if (IsSensorFile(name)) return ReadSensor(name);
  const std::vector<std::string> names = InstalledNames();
  if (std::ranges::find(names, name) != names.end()) return ReadSensor(PathOf(name));
  const std::string problem = absl::StrCat("'", formats::OneLine(name), "' is no sensor");
  if (names.empty()) {
    return absl::NotFoundError(absl::StrCat(problem, " (there are none in ", SensorsDirectory().string(),
                                            "); name the folder of sensors by ALBTPU_SENSORS, or give the "
                                            "path of a file"));
  }
  return absl::NotFoundError(absl::StrCat(
      problem, formats::Suggestion(name, names, absl::StrCat("there are ", absl::StrJoin(names, ", ")))));
}

}  // namespace albtpu::config
