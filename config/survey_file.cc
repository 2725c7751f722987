#include "config/survey_file.h"

#include <string>

#include "config/sensors/installed_sensors.h"
#include "config/toml/toml_file.h"
#include "config/toml/toml_keys.h"
#include "sea/sea_time.h"

namespace albtpu::config {
namespace {

namespace fs = std::filesystem;

constexpr TomlKind kSurveyFile = {"a survey file", "the survey", "the path of --survey"};

JonswapWaves ReadWaves(TomlKeys& keys) {
  WaveSettings waves;
  ReadKeys(keys, kWaveKeys, "", waves);
  keys.Finish();
  const std::string problem = ProblemOf(waves, false);
  if (problem.empty()) return WavesOf(waves);
  keys.Fail(problem);
  return {};
}

// What of a section is not in the table of its keys.
void ReadMore(TomlKeys& keys, SeaSettings& sea) {
  if (sea.time.has_value() && !ParseSeaTime(*sea.time).has_value())
    keys.Fail("time is no time; give UTC as \"2020-06-08T03:50Z\"");
  for (TomlKeys& waves : keys.Tables("waves")) sea.waves.push_back(ReadWaves(waves));
}
void ReadMore(TomlKeys& keys, WaterSettings& water) {
  for (TomlKeys& table : keys.Table("calibration")) {
    ReadKeys(table, kCalibrationKeys, "", water.calibration.emplace());
    table.Finish();
  }
}
template <typename Settings>
void ReadMore(TomlKeys&, Settings&) {}

// Keys that contradict each other.
void CheckTogether(TomlKeys& keys, const TrajectorySettings& trajectory) {
  if (!trajectory.from_returns.value_or(false)) return;
  for (const std::string_view key : {"files", "errors", "time"})
    if (keys.Has(key))
      keys.Fail(key, "contradicts from_returns (a trajectory is one or the other); give one of them");
}
void CheckTogether(TomlKeys& keys, const SurfaceSettings& surface) {
  if (!keys.Has("level") || surface.located.value_or("level") == "level") return;
  keys.Fail("level", "contradicts located = \"" + *surface.located +
                         "\" (returns of the lidar locate the surface, or a level does); give one of them");
}
template <typename Settings>
void CheckTogether(TomlKeys&, const Settings&) {}

}  // namespace

absl::StatusOr<SurveySettings> ParseSurvey(std::string_view text, const fs::path& folder) {
  const absl::StatusOr<toml::table> root = ParseToml(text, kSurveyFile);
  if (!root.ok()) return root.status();
  TomlProblem problem(kSurveyFile);
  TomlKeys keys(*root, "", problem);
  SurveySettings survey;
  ForEachSection([&](std::string_view name, const auto& table, const auto& section) {
    if (name.find('.') != name.npos) return;  // A table in a section.
    for (TomlKeys& given : keys.Table(name)) {
      ReadKeys(given, table, folder, section(survey));
      ReadMore(given, section(survey));
      given.Finish();
      CheckTogether(given, section(survey));
    }
  });
  for (TomlKeys& section : keys.Table("sigma")) {
    for (std::size_t i = 0; i < kErrorSourceCount; ++i)
      config::ReadErrors(section, kErrorSources[i].name, i, survey.sigma);
    section.Finish();
  }
  keys.Finish();
  if (!problem.status().ok()) return problem.status();
  std::optional<std::string>& sensor = survey.sensor.name;
  if (sensor.has_value() && config::IsSensorFile(*sensor)) sensor = (folder / *sensor).string();
  return survey;
}

absl::StatusOr<SurveySettings> ReadSurvey(const fs::path& path) {
  const absl::StatusOr<std::string> text = ReadTomlText(path, kSurveyFile);
  if (!text.ok()) return text.status();
  absl::StatusOr<SurveySettings> survey = ParseSurvey(*text, path.parent_path());
  if (!survey.ok()) return InFile(path, survey.status());
  return survey;
}

}  // namespace albtpu::config
