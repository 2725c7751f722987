#include "config/sensors/sensor.h"

#include <cstdlib>
#include <system_error>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "formats/text/text.h"
#include "status/status_macros.h"
#include "tables/default_tables.h"

namespace albtpu::config {
std::string PartsText(const ErrorSource& source) {
  const auto append = [](std::string* to, std::string_view part) { to->append(part); };
  return absl::StrCat("[", absl::StrJoin(source.parts, ", ", append), "]");
}

void ReadErrors(config::TomlKeys& keys, std::string_view key, std::size_t i, StatedErrors& errors) {
  const ErrorSource& source = kErrorSources[i];
  const std::span<double> numbers = source.In(errors.values);
  if (numbers.size() == 1) {
    const std::optional<double> number = keys.Number(key, 0, source.greatest, source.unit);
    errors.stated[i] = number.has_value();
    numbers[0] = number.value_or(0);
  } else {
    const std::optional<std::array<double, 3>> triple =
        keys.Triple(key, 0, source.greatest, source.unit, PartsText(source));
    errors.stated[i] = triple.has_value();
    if (triple.has_value()) std::ranges::copy(*triple, numbers.begin());
  }
  if (!errors.stated[i] || source.unit != "degree") return;
  const auto radians = std::ranges::find_if(numbers, [](double number) { return number > 0 && number < kLeastAngle; });
  if (radians == numbers.end()) return;
  keys.Fail(key, absl::StrCat("is ", *radians, " degree (no instrument knows an angle better than ", kLeastAngle,
                              " degree, which looks like radians); give it in degree"));
}

namespace {

using namespace config;

constexpr TomlKind kSensorFile = {"a sensor file", "the sensor", "the name of the sensor"};

constexpr char kValue[] = "value";

// Before what is missing: a key that is unknown may be the missing one, misspelt.
void FinishNumber(TomlKeys& keys, const std::string& unit) {
  keys.OneOf("unit", {unit});
  keys.Finish();
  for (const auto& [key, remedy] : {std::pair<std::string_view, std::string>{kValue, "the number"},
                                    {"unit", absl::StrCat("\"", unit, "\"")},
                                    {"source", "where the number is from"}})
    if (!keys.Has(key)) keys.Fail(absl::StrCat(std::string(key), " is missing; give ", remedy));
}

std::string ReadSource(TomlKeys& keys) {
  const std::string source = keys.Text("source", "where the number is from").value_or("");
  if (!source.empty() && absl::StripAsciiWhitespace(source).empty())
    keys.Fail("source", "is blank; write where the number is from");
  return source;
}

void ReadNumbers(TomlKeys& root, std::size_t i, Sensor& sensor) {
  const ErrorSource& source = kErrorSources[i];
  for (TomlKeys& keys : root.Table(source.name)) {
    ReadErrors(keys, kValue, i, sensor.errors);
    if (sensor.errors.stated[i] && std::ranges::min(source.In(sensor.errors.values)) == 0)
      keys.Fail(kValue, "is 0 (no instrument is exact); leave out a number that no source gives");
    sensor.origins[i] = ReadSource(keys);
    FinishNumber(keys, std::string(source.unit));
  }
}

std::optional<SourcedDivergence> ReadDivergence(TomlKeys& root) {
  for (TomlKeys& keys : root.Table("divergence")) {
    const auto number = [&](std::string_view key) {
      return keys.Number(key, kLeastDivergence, kGreatestDivergence, "mrad");
    };
    SourcedDivergence divergence{.value = number(kValue).value_or(0),
                                 .least = number("least"),
                                 .greatest = number("greatest"),
                                 .source = ReadSource(keys)};
    FinishNumber(keys, "mrad");
    if (divergence.least.has_value() != divergence.greatest.has_value()) {
      keys.Fail("has one of least and greatest; give both, or none where the divergence does not vary");
    } else if (divergence.least.has_value() &&
               !(divergence.least < divergence.greatest && divergence.least <= divergence.value &&
                 divergence.value <= divergence.greatest)) {
      keys.Fail(absl::StrCat("value is ", divergence.value, " (least is ", *divergence.least, ", greatest ",
                             *divergence.greatest, "); give them in order"));
    }
    return divergence;
  }
  return std::nullopt;
}

std::optional<SourcedChannel> ReadSurfaceChannel(TomlKeys& root) {
  for (TomlKeys& keys : root.Table("surface_channel")) {
    const std::vector<std::string> words(kSurfaceChannels.begin(), kSurfaceChannels.end());
    SourcedChannel channel{.value = keys.OneOf(kValue, words).value_or(""), .source = ReadSource(keys)};
    keys.Finish();
    if (!keys.Has(kValue)) keys.Fail("value is missing; give \"green\" or \"infrared\"");
    if (!keys.Has("source")) keys.Fail("source is missing; give where this is from");
    return channel;
  }
  return std::nullopt;
}

}  // namespace

absl::StatusOr<Sensor> ParseSensor(std::string_view text) {
  ASSIGN_OR_RETURN(const toml::table root, ParseToml(text, kSensorFile));
  TomlProblem problem(kSensorFile);
  TomlKeys keys(root, "", problem);
  Sensor sensor;
  sensor.title = keys.Text("title", "what people call the sensor").value_or("");
  for (std::size_t i = 0; i < kErrorSourceCount; ++i)
    if (kErrorSources[i].of_sensor) ReadNumbers(keys, i, sensor);
  sensor.divergence = ReadDivergence(keys);
  sensor.surface_channel = ReadSurfaceChannel(keys);
  keys.Finish();
  if (!problem.status().ok()) return problem.status();
  if (sensor.title.empty())
    return absl::InvalidArgumentError("line 1: title is missing; give what people call the sensor");
  return sensor;
}

absl::StatusOr<Sensor> ReadSensor(const std::filesystem::path& path) {
  ASSIGN_OR_RETURN(const std::string text, ReadTomlText(path, kSensorFile));
  absl::StatusOr<Sensor> sensor = ParseSensor(text);
  if (!sensor.ok()) return InFile(path, sensor.status());
  sensor->name = path.stem().string();
  sensor->path = path.string();
  return sensor;
}

std::vector<std::string> UnknownOf(const Sensor& sensor) {
  std::vector<std::string> unknown;
  for (std::size_t i = 0; i < kErrorSourceCount; ++i)
    if (kErrorSources[i].of_sensor && !sensor.errors.stated[i]) unknown.emplace_back(kErrorSources[i].name);
  if (!sensor.divergence.has_value()) unknown.emplace_back("divergence");
  return unknown;
}

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
    ASSIGN_OR_RETURN(Sensor sensor, ReadSensor(PathOf(name)));
    sensors.push_back(std::move(sensor));
  }
  return sensors;
}

bool IsSensorFile(std::string_view name) { return name.ends_with(".toml") || name.find('/') != std::string_view::npos; }

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
  return absl::NotFoundError(
      absl::StrCat(problem, formats::Suggestion(name, names, absl::StrCat("there are ", absl::StrJoin(names, ", ")))));
}

}  // namespace albtpu::config
