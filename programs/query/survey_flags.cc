#include "programs/query/survey_flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "absl/strings/str_cat.h"
#include "annotate/run/file_progress.h"
#include "config/doubts.h"
#include "config/key_list.h"
#include "programs/command_line/command_line.h"
#include "programs/query/options.h"
#include "status/status_macros.h"

namespace albtpu::programs {
namespace {

using config::FlagKey;
using config::SurveySettings;

config::Value Parsed(const FlagKey& key, const std::string& text) {
  absl::StatusOr<config::Value> value = ParseValue(*key.declaration, text);
  if (value.ok()) return *std::move(value);
  throw CLI::ValidationError(std::string(key.declaration->flag), std::string(value.status().message()));
}

void AddFlag(CLI::App& command, std::string_view name, const char* heading, SurveySettings& settings) {
  const FlagKey key = config::FindFlag(name);
  const std::string flag(name), help = HelpText(*key.declaration);
  const config::KeyValues& values = key.declaration->values;
  CLI::Option* option = nullptr;
  if (std::holds_alternative<config::YesOrNo>(values)) {
    option = command.add_flag_callback(
        flag, [key, &settings] { key.put(true, settings); }, help);
  } else if (std::holds_alternative<config::Paths>(values)) {
    option = command
                 .add_option_function<std::vector<std::string>>(
                     flag,
                     [key, &settings](const std::vector<std::string>& paths) {
                       for (const std::string& path : paths) Parsed(key, path);
                       key.put(paths, settings);
                     },
                     help + "; may be repeated")
                 ->expected(1)
                 ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  } else {
    option = command.add_option_function<std::string>(
        flag, [key, &settings](const std::string& text) { key.put(Parsed(key, text), settings); }, help);
  }
  option->group(heading);
  if (!std::holds_alternative<config::YesOrNo>(values)) option->type_name(config::FactsOf(values).shown);
}

void AddSwell(CLI::App& command, config::SeaSettings& sea) {
  command
      .add_option_function<std::vector<std::string>>(
          "--swell",
          [&sea](const std::vector<std::string>& texts) {
            for (const std::string& each : texts) {
              const absl::StatusOr<JonswapWaves> swell = config::ParseSwell(each);
              if (!swell.ok()) throw CLI::ValidationError("--swell", std::string(swell.status().message()));
              sea.waves.push_back(*swell);
            }
          },
          "Swell: height [m], peak period [s], direction it comes from and spread [degree] (default 18); "
          "gamma is 7; "
          "may be repeated")
      ->type_name("HS,TP,FROM[,SPREAD]")
      ->expected(1)
      ->delimiter('\0')
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group(group::kSea);
}

// Rounded once. A fetch beyond the range of float32 becomes the largest float32.
std::optional<float> Rounded(const std::optional<double>& number) {
  if (!number.has_value()) return std::nullopt;
  constexpr double kGreatest = std::numeric_limits<float>::max();
  return static_cast<float>(std::isfinite(*number) ? std::min(*number, kGreatest) : *number);
}

}  // namespace

void AddFlags(CLI::App& command, std::initializer_list<const char*> names, const char* heading, SurveyFlags& flags) {
  for (const char* name : names) AddFlag(command, name, heading, flags.settings);
}

void AddSeaFlags(CLI::App& command, SurveyFlags& flags, std::span<const std::string_view> without) {
  command
      .add_option("--survey", flags.survey,
                  "What is known of the survey, as TOML: sensor, trajectory, surface, sea, water, datum, extra, output "
                  "(albtpu-query keys)")
      ->type_name("FILE.toml")
      ->check(NotEmpty("file"))
      ->group(group::kSea);
  config::ForEachSection([&](std::string_view section, const auto& keys, const auto&) {
    if (!section.starts_with("sea")) return;
    for (const auto& key : keys)
      if (std::ranges::find(without, key.declaration.flag) == without.end())
        AddFlag(command, key.declaration.flag, group::kSea, flags.settings);
  });
  AddSwell(command, flags.settings.sea);
  AddFlags(command, {"--water-index"}, group::kSea, flags);
}

void AddTotalFlags(CLI::App& command, SurveyFlags& flags) {
  AddFlags(command, {"--sensor", "--surface-located", "--surface-channel", "--datum-sigma", "--water-column"},
           group::kTotal, flags);
}

void AddStyleFlags(CLI::App& command, SurveyFlags& flags, annotate::AnswerStyle& style) {
  AddFlags(command, {"--coverage", "--s44-order"}, group::kOutput, flags);
  command
      .add_flag_callback(
          "--standard-errors", [&style] { style.standard_errors = true; }, "Give the standard error of each value, too")
      ->group(group::kOutput);
}

absl::StatusOr<SurveySettings> SettingsOf(const SurveyFlags& flags) {
  SurveySettings given = flags.settings;
  RETURN_IF_ERROR(CompleteWaves(given.sea));
  absl::StatusOr<SurveySettings> file = SurveySettings();
  if (flags.survey.has_value()) file = config::ReadSurvey(*flags.survey);
  if (!file.ok()) return file;
  SurveySettings settings = Merge(given, *std::move(file));
  RETURN_IF_ERROR(CheckSea(settings.sea));
  for (const std::string& doubt : config::Doubts(settings)) annotate::Note(doubt);
  return settings;
}

nlohmann::ordered_json ProjectJson(const config::ProjectSettings& project) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& key : config::kProjectKeys) {
    const std::optional<std::string>& text =
        project.*std::get<std::optional<std::string> config::ProjectSettings::*>(key.member);
    if (text.has_value()) json[std::string(key.declaration.key)] = *text;
  }
  return json;
}

absl::Status CheckTotalFlags(const SurveyFlags& flags, const SurveySettings& settings) {
  if (settings.wants_total()) return absl::OkStatus();
  const SurveySettings& given = flags.settings;
  const std::pair<const char*, bool> flags_of_total[] = {{"--surface-located", given.surface.located.has_value()},
                                                         {"--surface-channel", given.surface.channel.has_value()},
                                                         {"--datum-sigma", given.datum.sigma.has_value()},
                                                         {"--water-column", given.water.column.has_value()}};
  for (const auto& [flag, is_given] : flags_of_total)
    if (is_given)
      return formats::UsageError(absl::StrCat(flag, " has no effect without --sensor; give both or none of them"));
  if (config::IsAnyGiven(config::kExtraKeys, settings.extra))
    return formats::UsageError("[extra] has no effect without a sensor; give [sensor] name, or --sensor");
  if (settings.sigma.any())
    return formats::UsageError("[sigma] has no effect without a sensor; give [sensor] name, or --sensor");
  return absl::OkStatus();
}

void TakeStyle(const config::OutputSettings& output, annotate::AnswerStyle& style) {
  style.coverage = *annotate::FindCoverage(output.coverage.value_or(std::string(config::kUsualCoverage)));
  if (output.s44_order.has_value()) style.s44_order = FindS44Order(*output.s44_order);
}

void TakeWind(const config::SeaSettings& sea, annotate::FixedInputs& inputs) {
  inputs.any_sea = sea.has_waves();
  if (!inputs.any_sea) StateWind(sea, inputs);
}

void StateWind(const config::SeaSettings& sea, annotate::FixedInputs& inputs) {
  inputs[annotate::PulseInput::kWindSpeed] = Rounded(sea.wind_speed);
  inputs[annotate::PulseInput::kFetch] = Rounded(sea.fetch);
  inputs[annotate::PulseInput::kWindFrom] = Rounded(sea.wind_from);
}

absl::StatusOr<std::optional<annotate::SeaTimeline>> GivenSeas(const SurveyFlags& flags,
                                                               const SurveySettings& settings) {
  if (const config::SeaSettings& sea = flags.settings.sea;
      !settings.sea.has_waves() && (sea.wind_speed.has_value() || sea.wind_from.has_value()))
    return formats::UsageError(
        "--wind-speed and --wind-from have no effect without waves, because the files state their wind; leave them "
        "out");
  std::optional<annotate::SeaTimeline> seas;
  if (settings.sea.has_waves()) {
    ASSIGN_OR_RETURN(seas, annotate::SeaTimeline::Open(settings.sea));
  }
  return seas;
}

std::vector<std::filesystem::path> FilesOf(const SurveyFlags& flags, const SurveySettings& settings) {
  std::vector<std::filesystem::path> files;
  for (const std::optional<std::string>& file : {flags.survey, settings.sea.file})
    if (file.has_value()) files.emplace_back(*file);
  std::vector<std::optional<std::string>> sensors = {settings.sensor.name};
  for (const config::ChannelSettings& channel : settings.sensor.channels) sensors.push_back(channel.name);
  for (const std::optional<std::string>& sensor : sensors)
    if (std::error_code error; sensor.has_value() && std::filesystem::exists(*sensor, error))
      files.emplace_back(*sensor);
  return files;
}

}  // namespace albtpu::programs
