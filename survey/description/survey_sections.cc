#include "survey/description/survey_sections.h"

#include <string>
#include <vector>

#include "budget/water/water_share.h"
#include "sea/sea_time.h"
#include "survey/sensors/installed_sensors.h"
#include "tables/s44.h"

namespace albtpu::client {
namespace {

namespace fs = std::filesystem;

template <typename Words>
std::vector<std::string> Texts(const Words& words) {
  return {words.begin(), words.end()};
}

template <typename Numbers, typename Told>
void ReadNumbers(TomlKeys& keys, const Numbers& numbers, Told& told) {
  for (const auto& each : numbers)
    told.*each.field = keys.Number(each.key, each.least, each.greatest, each.unit);
}

std::vector<std::string> ReadPaths(TomlKeys& keys, std::string_view key, const fs::path& folder) {
  std::vector<std::string> paths = keys.Texts(key, "the path of a file or folder");
  for (std::string& path : paths) path = (folder / path).string();
  return paths;
}

JonswapWaves ReadWaves(TomlKeys& keys) {
  ToldWaves told;
  ReadNumbers(keys, kWaveNumbers, told);
  told.spreading = keys.OneOf("spreading", {std::string(kMitsuyasu)});
  keys.Finish();
  const std::string problem = ProblemOf(told, "");
  if (problem.empty()) return WavesOf(told);
  keys.Fail(problem);
  return {};
}

}  // namespace

ToldSea ReadSea(TomlKeys& keys, const fs::path& folder) {
  ToldSea sea;
  ReadNumbers(keys, kSeaNumbers, sea);
  sea.tail = keys.OneOf("tail", Texts(kTailRules));
  sea.place = keys.Text("place", "a name, or \"LAT,LON\"");
  sea.time = keys.Text("time", "UTC, such as \"2020-06-08T03:50Z\"");
  sea.file = keys.Text("file", "the path of a file of the sea");
  if (sea.time.has_value() && !ParseSeaTime(*sea.time).has_value())
    keys.Fail("time is no time; give UTC as \"2020-06-08T03:50Z\"");
  if (sea.file.has_value()) sea.file = (folder / *sea.file).string();
  for (TomlKeys& waves : keys.Tables("waves")) sea.waves.push_back(ReadWaves(waves));
  keys.Finish();
  return sea;
}

ToldSensor ReadToldSensor(TomlKeys& keys, const fs::path& folder) {
  ToldSensor sensor;
  sensor.name = keys.Text("name", "the name of a sensor, or the path of its file");
  if (sensor.name.has_value() && IsSensorFile(*sensor.name)) sensor.name = (folder / *sensor.name).string();
  sensor.lever_arm =
      keys.Triple("lever_arm", -kLongestLeverArm, kLongestLeverArm, "m", "[forward, right, down]");
  keys.Finish();
  return sensor;
}

ToldTrajectory ReadTrajectory(TomlKeys& keys, const fs::path& folder) {
  ToldTrajectory trajectory;
  trajectory.files = ReadPaths(keys, "files", folder);
  trajectory.errors = ReadPaths(keys, "errors", folder);
  trajectory.time = keys.OneOf("time", Texts(kTrajectoryTimes));
  trajectory.from_returns = keys.Flag("from_returns");
  keys.Finish();
  if (!trajectory.from_returns.value_or(false)) return trajectory;
  for (const std::string_view key : {"files", "errors", "time"})
    if (keys.Has(key))
      keys.Fail(key, "contradicts from_returns (a trajectory is one or the other); give one of them");
  return trajectory;
}

ToldSurface ReadSurface(TomlKeys& keys, const fs::path& folder) {
  ToldSurface surface;
  surface.classes = keys.WholeNumbers("classes", 0, kGreatestClass);
  surface.located = keys.OneOf("located", Texts(kWaysToLocate));
  if (keys.IsText("level")) {
    surface.level_file = keys.Text("level", "a height, or the path of a file of heights");
    if (surface.level_file.has_value()) surface.level_file = (folder / *surface.level_file).string();
  } else {
    surface.level = keys.Number("level", kLeastLevel, kGreatestLevel, "1");
  }
  keys.Finish();
  if (keys.Has("level") && surface.located.has_value() && surface.located != "level") {
    keys.Fail("level", "contradicts located = \"" + *surface.located +
                           "\" (returns of the lidar locate the surface, or a level does); give one of them");
  }
  return surface;
}

ToldWater ReadWater(TomlKeys& keys) {
  ToldWater water;
  ReadNumbers(keys, kWaterNumbers, water);
  water.without_column = keys.OneOf("column", {"none"}).has_value();
  water.kd_kind = keys.OneOf("kd_kind", Texts(kKdKindNames));
  water.jerlov = keys.OneOf("jerlov", Texts(kJerlovTypes));
  water.detector = keys.OneOf("detector", Texts(kEchoDetectorNames));
  water.bias = keys.OneOf("bias", Texts(kBiasHandlingNames));
  for (TomlKeys& table : keys.Table("calibration")) {
    ReadNumbers(table, kCalibrationNumbers, water.calibration.emplace());
    table.Finish();
  }
  keys.Finish();
  return water;
}

ToldDatum ReadDatum(TomlKeys& keys) {
  ToldDatum datum;
  ReadNumbers(keys, kDatumNumbers, datum);
  keys.Finish();
  return datum;
}

StatedErrors ReadSigma(TomlKeys& keys) {
  StatedErrors sigma;
  for (std::size_t i = 0; i < kErrorSourceCount; ++i) ReadErrors(keys, kErrorSources[i].name, i, sigma);
  keys.Finish();
  return sigma;
}

ToldOutput ReadOutput(TomlKeys& keys) {
  ToldOutput output;
  output.classes = keys.WholeNumbers("classes", 0, kGreatestClass);
  output.coverage = keys.OneOf("coverage", Texts(kCoverages));
  std::vector<std::string> orders;
  for (const S44Order order : kS44Orders) orders.emplace_back(Name(order));
  output.s44_order = keys.OneOf("s44_order", orders);
  output.details = keys.Flag("details");
  keys.Finish();
  return output;
}

}  // namespace albtpu::client
