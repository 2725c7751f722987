#include "config/survey_settings.h"

#include <algorithm>
#include <cassert>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "config/toml/toml_keys.h"
#include "sea/sea_time.h"
#include "status/status_macros.h"
#include "tables/coverage.h"

namespace albtpu::config {
FlagKey FindFlag(std::string_view flag) {
  FlagKey found;
  ForEachSection([&](const char*, const auto& keys, const auto& section) {
    for (const auto& key : keys) {
      if (key.declaration.flag != flag) continue;
      found = {&key.declaration,
               [&key, section](const Value& value, SurveySettings& settings) { Put(value, key, section(settings)); }};
    }
  });
  assert(found.declaration != nullptr);
  return found;
}

std::optional<double> DatumSettings::standard_deviation() const {
  if (!mcu.has_value()) return sigma;
  return confidence == kConfidences[1] ? *mcu / VerticalFactor(Coverage::kP95) : *mcu;
}

SurveySettings SurveySettings::OfChannel(const ChannelSettings& channel) const {
  SurveySettings survey = *this;
  survey.sensor = {.name = channel.name, .lever_arm = channel.lever_arm, .channels = {}};
  if (!channel.lever_arm.has_value()) survey.sensor.lever_arm = sensor.lever_arm;
  for (std::size_t i = 0; i < kErrorSourceCount; ++i) {
    if (!channel.sigma.stated[i]) continue;
    survey.sigma.stated[i] = true;
    std::ranges::copy(kErrorSources[i].In(channel.sigma.values), kErrorSources[i].In(survey.sigma.values).begin());
  }
  return survey;
}

SurveySettings Merge(const SurveySettings& flags, SurveySettings file) {
  if (flags.sea.has_waves()) {  // Then what goes with the waves of the survey file goes with them.
    SeaSettings& sea = file.sea;
    sea.waves.clear();
    sea.file = sea.place = sea.time = {};
    sea.longest_gap = sea.anemometer_height = sea.fetch = sea.tail_from = {};
    sea.tail = {};
  }
  if (flags.trajectory.is_given()) file.trajectory = {};
  if (flags.sensor.name.has_value()) file.sensor.channels.clear();
  if (flags.datum.sigma.has_value()) file.datum.mcu = {}, file.datum.confidence = file.datum.region = {};
  ForEachSection(
      [&](const char*, const auto& keys, const auto& section) { Override(keys, section(flags), section(file)); });
  if (!flags.sea.waves.empty()) file.sea.waves = flags.sea.waves;
  return file;
}

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
void ReadMore(TomlKeys& keys, const fs::path& folder, SensorSettings& sensor) {
  sensor.channels = ReadChannels(keys, folder);
}
void ReadMore(TomlKeys& keys, const fs::path&, SeaSettings& sea) {
  if (sea.time.has_value() && !ParseSeaTime(*sea.time).has_value())
    keys.Fail("time is no time; give UTC as \"2020-06-08T03:50Z\"");
  for (TomlKeys& waves : keys.Tables("waves")) sea.waves.push_back(ReadWaves(waves));
}
void ReadMore(TomlKeys& keys, const fs::path&, WaterSettings& water) {
  for (TomlKeys& table : keys.Table("calibration")) {
    ReadKeys(table, kCalibrationKeys, "", water.calibration.emplace());
    table.Finish();
  }
}
template <typename Settings>
void ReadMore(TomlKeys&, const fs::path&, Settings&) {}

// Keys that contradict each other.
void CheckTogether(TomlKeys& keys, const TrajectorySettings& trajectory) {
  if (!trajectory.from_returns.value_or(false)) return;
  for (const std::string_view key : {"files", "errors", "time", "velocity_axes"})
    if (keys.Has(key)) keys.Fail(key, "contradicts from_returns (a trajectory is one or the other); give one of them");
}
void CheckTogether(TomlKeys& keys, const SurfaceSettings& surface) {
  if (!keys.Has("level") || surface.located.value_or("level") == "level") return;
  keys.Fail("level", "contradicts located = \"" + *surface.located +
                         "\" (returns of the lidar locate the surface, or a level does); give one of them");
}
void CheckTogether(TomlKeys& keys, const DatumSettings&) {
  if (keys.Has("mcu") && keys.Has("sigma"))
    keys.Fail("mcu",
              "is given beside sigma (both are the uncertainty of the vertical datum, which would count twice); "
              "give one of them");
  if (keys.Has("mcu") && !keys.Has("confidence"))
    keys.Fail("mcu", "has no confidence; give confidence = \"1sigma\" (as VDatum and cBLUE state it) or \"95%\"");
  if (keys.Has("confidence") && keys.Has("sigma"))
    keys.Fail("confidence", "contradicts sigma (which is one standard deviation); give mcu with it, or leave it out");
}
template <typename Settings>
void CheckTogether(TomlKeys&, const Settings&) {}

}  // namespace

absl::StatusOr<SurveySettings> ParseSurvey(std::string_view text, const fs::path& folder) {
  ASSIGN_OR_RETURN(const toml::table root, ParseToml(text, kSurveyFile));
  TomlProblem problem(kSurveyFile);
  TomlKeys keys(root, "", problem);
  SurveySettings survey;
  ForEachSection([&](std::string_view name, const auto& table, const auto& section) {
    if (name.find('.') != name.npos) return;  // A table in a section.
    for (TomlKeys& given : keys.Table(name)) {
      ReadKeys(given, table, folder, section(survey));
      ReadMore(given, folder, section(survey));
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
  ASSIGN_OR_RETURN(const std::string text, ReadTomlText(path, kSurveyFile));
  absl::StatusOr<SurveySettings> survey = ParseSurvey(text, path.parent_path());
  if (!survey.ok()) return InFile(path, survey.status());
  return survey;
}

}  // namespace albtpu::config
