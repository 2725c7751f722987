#include "config/sensors/sensor.h"

#include <algorithm>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"

namespace albtpu::config {
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
                                    {"source", "where the number is from"}}) {
    if (!keys.Has(key)) keys.Fail(absl::StrCat(std::string(key), " is missing; give ", remedy));
  }
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

}  // namespace

absl::StatusOr<Sensor> ParseSensor(std::string_view text) {
  const absl::StatusOr<toml::table> root = ParseToml(text, kSensorFile);
  if (!root.ok()) return root.status();
  TomlProblem problem(kSensorFile);
  TomlKeys keys(*root, "", problem);
  Sensor sensor;
  sensor.title = keys.Text("title", "what people call the sensor").value_or("");
  for (std::size_t i = 0; i < kErrorSourceCount; ++i)
    if (kErrorSources[i].of_sensor) ReadNumbers(keys, i, sensor);
  sensor.divergence = ReadDivergence(keys);
  keys.Finish();
  if (!problem.status().ok()) return problem.status();
  if (sensor.title.empty())
    return absl::InvalidArgumentError("line 1: title is missing; give what people call the sensor");
  return sensor;
}

absl::StatusOr<Sensor> ReadSensor(const std::filesystem::path& path) {
  const absl::StatusOr<std::string> text = ReadTomlText(path, kSensorFile);
  if (!text.ok()) return text.status();
  absl::StatusOr<Sensor> sensor = ParseSensor(*text);
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

}  // namespace albtpu::config
