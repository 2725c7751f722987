#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "annotate/run/file_progress.h"
#include "config/key_list.h"
#include "config/sensors/sensor.h"
#include "config/survey_settings.h"
#include "programs/command_line/command_line.h"
#include "programs/command_line/manual.h"
#include "programs/query/commands.h"
#include "programs/query/options.h"
#include "service/printable_text.h"
#include "status/status_macros.h"
#include "tables/version.h"

namespace albtpu::programs {
namespace {

using config::ListedKey;
using nlohmann::ordered_json;

constexpr char kIntroduction[] = R"(# Keys of the survey file

A survey file is TOML and says what is known of a survey beside its points: `albtpu-query las`, `csv`, `pulse`, `plan`
and `sea` take it by `--survey FILE.toml`. A flag overrides the key of the same meaning. Paths count from the folder of
the survey file. Waves are any number of tables `[[sea.waves]]`, and so are the scanners of a LAS file with several,
`[[sensor.channel]]`, each of which may have a table `[sensor.channel.sigma]`: the keys of `[sigma]` that sensor files
have, too. This page is the output of `albtpu-query keys`; a test compares them.
)";

std::string TypeText(const ListedKey& key) {
  return absl::StrCat(key.values.type, key.values.unit.empty() ? "" : ", ", key.values.unit);
}

std::string Markdown(const std::vector<ListedKey>& keys) {
  std::string page = kIntroduction, section;
  for (const ListedKey& key : keys) {
    if (key.section != section) {
      const bool many = config::IsOfMany(key.section);
      absl::StrAppend(&page, "\n## ", many ? "[[" : "[", key.section, many ? "]]" : "]",
                      "\n\n| key | type, unit | range | default | flag | meaning |\n|---|---|---|---|---|---|\n");
    }
    section = key.section;
    absl::StrAppend(&page, "| `", key.key, "` | ", TypeText(key), " | ", RangeText(key.values), " | ", key.absent,
                    " | ", key.flag.empty() ? "" : absl::StrCat("`", key.flag, "`"), " | ", key.help, " |\n");
  }
  return page;
}

ordered_json JsonOfKeys(const std::vector<ListedKey>& keys) {
  const auto or_null = [](const std::string& text) { return text.empty() ? ordered_json() : ordered_json(text); };
  const auto limit = [](const std::optional<double>& number) {
    return number.has_value() && std::isfinite(*number) ? ordered_json(*number) : ordered_json();
  };
  ordered_json json = {{"keys", ordered_json::array()}};
  for (const ListedKey& key : keys)
    json["keys"].push_back({{"section", key.section},
                            {"key", key.key},
                            {"type", key.values.type},
                            {"unit", or_null(key.values.unit)},
                            {"least", limit(key.values.least)},
                            {"greatest", limit(key.values.greatest)},
                            {"words", key.values.words},
                            {"default", or_null(key.absent)},
                            {"flag", or_null(key.flag)},
                            {"help", key.help}});
  return json;
}

constexpr char kManualIntroduction[] = R"(A survey file is TOML and says what is known of a survey beside its points.

  albtpu-query las --survey survey.toml line.las annotated.las

A flag overrides the key of the same meaning. Paths count from the folder of the survey file. The sections and keys are:
)";

// albtpu-survey(5).
std::string Manual(const std::vector<ListedKey>& keys) {
  std::string page = ManualHead("albtpu-survey", "5", std::string(Version()), "survey file of albtpu-query"), section;
  absl::StrAppend(&page, ".SH DESCRIPTION\n", Troff(kManualIntroduction));
  for (const ListedKey& key : keys) {
    const bool many = config::IsOfMany(key.section);
    if (key.section != section)
      absl::StrAppend(&page, ".SH \"", many ? "[[" : "[", key.section, many ? "]] (any number of tables)" : "]",
                      "\"\n");
    section = key.section;
    std::vector<std::string> facts = {TypeText(key)};
    if (const std::string range = RangeText(key.values); !range.empty()) facts.push_back(range);
    if (!key.absent.empty()) facts.push_back("default: " + key.absent);
    if (!key.flag.empty()) facts.push_back(key.flag);
    absl::StrAppend(&page, ".TP\n.B ", Troff(key.key),
                    Troff(absl::StrCat(key.help, " (", absl::StrJoin(facts, "; "), ").")));
  }
  return page + ".SH SEE ALSO\n\\fBalbtpu\\-query\\fR(1), /usr/share/doc/albtpu/docs/survey.md\n";
}

struct KeysCommandOptions {
  bool json = false, manual = false;
};

absl::Status RunKeys(const KeysCommandOptions& options) {
  const std::vector<ListedKey> keys = config::ListKeys();
  std::cout << (options.manual ? Manual(keys) : options.json ? JsonOfKeys(keys).dump(2) + "\n" : Markdown(keys));
  return FlushStandardOutput();
}

struct SensorsCommandOptions {
  std::string name;
  bool json = false;
};

std::string DivergenceText(const config::SourcedDivergence& divergence) {
  std::string text = absl::StrCat(divergence.value);
  if (divergence.least.has_value()) absl::StrAppend(&text, " (", *divergence.least, " to ", *divergence.greatest, ")");
  return text;
}

std::string Row(const config::Sensor& sensor) {
  const auto number = [&](double AirErrors::*source) {
    return sensor.errors.Has(source) ? absl::StrCat(sensor.errors.values.*source) : "-";
  };
  return absl::StrFormat("%-26s%-42s%10s%14s%16s\n", PrintableText(sensor.name), PrintableText(sensor.title),
                         number(&AirErrors::scan), number(&AirErrors::bottom_range),
                         sensor.divergence.has_value() ? DivergenceText(*sensor.divergence) : "-");
}

std::string Rows(const std::vector<config::Sensor>& sensors) {
  std::string text = absl::StrFormat("%-26s%-42s%10s%14s%16s\n%78s%14s%16s\n", "name", "title", "scan", "bottom_range",
                                     "divergence", "degree", "m", "mrad");
  for (const config::Sensor& sensor : sensors) absl::StrAppend(&text, Row(sensor));
  return text;
}

std::string Text(const config::Sensor& sensor) {
  std::string text = absl::StrCat(PrintableText(sensor.name), ": ", PrintableText(sensor.title), "\n");
  const auto line = [&text](std::string_view key, const std::string& value, std::string_view unit,
                            const std::string& source) {
    absl::StrAppendFormat(&text, "  %-14s %s %s, %s\n", key, value, unit, PrintableText(source));
  };
  for (std::size_t i = 0; i < kErrorSourceCount; ++i) {
    if (!sensor.errors.stated[i]) continue;
    const ErrorSource& source = kErrorSources[i];
    const std::string numbers = absl::StrJoin(source.In(sensor.errors.values), ", ");
    line(source.name, source.size() > 1 ? absl::StrCat("[", numbers, "]") : numbers, source.unit, sensor.origins[i]);
  }
  if (const auto& known = sensor.divergence) line("divergence", DivergenceText(*known), "mrad", known->source);
  if (const auto& known = sensor.surface_channel) line("surface_channel", known->value, "laser", known->source);
  std::vector<std::string> unknown = config::UnknownOf(sensor);
  const bool no_divergence = std::erase(unknown, "divergence") > 0;
  if (!unknown.empty())
    absl::StrAppend(&text, "  not known; give it in [sigma] of the survey file: ", absl::StrJoin(unknown, ", "), "\n");
  if (no_divergence) absl::StrAppend(&text, "  not known; give it by --divergence: divergence\n");
  return text;
}

ordered_json JsonOfSensor(const config::Sensor& sensor) {
  ordered_json json = {{"name", sensor.name}, {"title", sensor.title}};
  for (std::size_t i = 0; i < kErrorSourceCount; ++i) {
    if (!sensor.errors.stated[i]) continue;
    const ErrorSource& source = kErrorSources[i];
    const std::span<const double> numbers = source.In(sensor.errors.values);
    ordered_json value = numbers[0];
    if (numbers.size() > 1) value = numbers;
    json[std::string(source.name)] = {
        {"value", value}, {"unit", std::string(source.unit)}, {"source", sensor.origins[i]}};
  }
  if (const auto& known = sensor.divergence) {
    ordered_json& divergence = json["divergence"] = {{"value", known->value}};
    if (known->least.has_value()) divergence["least"] = *known->least, divergence["greatest"] = *known->greatest;
    divergence["unit"] = "mrad";
    divergence["source"] = known->source;
  }
  if (const auto& known = sensor.surface_channel)
    json["surface_channel"] = {{"value", known->value}, {"source", known->source}};
  json["unknown"] = config::UnknownOf(sensor);
  return json;
}

absl::Status RunSensors(const SensorsCommandOptions& options) {
  if (!options.name.empty()) {
    ASSIGN_OR_RETURN(const config::Sensor sensor, config::FindSensor(options.name));
    std::cout << (options.json ? JsonOfSensor(sensor).dump(2) + "\n" : Text(sensor));
    return FlushStandardOutput();
  }
  ASSIGN_OR_RETURN(const std::vector<config::Sensor> sensors, config::ListSensors());
  if (sensors.empty()) {
    annotate::Note(absl::StrCat("there are no sensors in ", config::SensorsDirectory().string(),
                                "; name their folder by the environment variable ALBTPU_SENSORS"));
  }
  if (options.json) {
    ordered_json json = {{"sensors", ordered_json::array()}};
    for (const config::Sensor& sensor : sensors) json["sensors"].push_back(JsonOfSensor(sensor));
    std::cout << json.dump(2) << "\n";
  } else if (!sensors.empty()) {
    std::cout << Rows(sensors);
  }
  return FlushStandardOutput();
}

}  // namespace

void AddKeysCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<KeysCommandOptions>();
  CLI::App* command =
      program.add_subcommand("keys", "List the keys of the survey file: type, unit, range, default, flag, meaning");
  command->add_flag("--json", options->json, "Print one JSON object with an array `keys`")->group(group::kOutput);
  command->add_flag("--man-page", options->manual)->group("");
  EndHelp(*command, "", "", "--json");
  command->callback([options, &run] { run = [options] { return RunKeys(*options); }; });
}

void AddSensorsCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<SensorsCommandOptions>();
  CLI::App* command =
      program.add_subcommand("sensors", "List the sensors that are known, or show one with its sources");
  command->add_option("name", options->name, "A sensor, or the path of its file; without it, all are listed")
      ->type_name("NAME")
      ->check(NotEmpty("sensor"));
  command->add_flag("--json", options->json, "Print one JSON object; of all sensors, with an array `sensors`")
      ->group(group::kOutput);
  EndHelp(*command,
          "Numbers are standard deviations; the divergence is the full angle. What no source gives is not "
          "known.\n"
          "The environment variable ALBTPU_SENSORS names another folder of sensors.",
          "riegl-vq-880-g", "my_sensor.toml --json");
  command->callback([options, &run] { run = [options] { return RunSensors(*options); }; });
}

}  // namespace albtpu::programs
