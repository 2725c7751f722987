#include "survey/commands/sea_options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "absl/strings/str_cat.h"
#include "command_line/checks.h"
#include "sea/sea_time.h"
#include "survey/answers/interpolation_error.h"
#include "survey/commands/options.h"
#include "survey/description/survey_description.h"
#include "survey/exit_status.h"
#include "survey/number_text.h"
#include "survey/seas/sea_facts.h"

namespace albtpu::client {
namespace {

// Throws where the text is no number in the range.
double InRange(std::string_view flag, const std::string& text, double least, double greatest,
               std::string_view unit) {
  const std::optional<double> value = ParseDouble(text);
  if (value.has_value() && *value >= least && *value <= greatest) return *value;
  throw CLI::ValidationError(std::string(flag),
                             absl::StrCat("is '", text, "'; give ", RangeText(least, greatest, unit)));
}

template <typename Told>
void AddNumberOf(CLI::App& command, const ToldNumber<Told>& number, Told& told) {
  command
      .add_option_function<std::string>(
          std::string(number.flag),
          [&number, &told](const std::string& text) {
            told.*number.field = InRange(number.flag, text, number.least, number.greatest, number.unit);
          },
          std::string(number.help))
      ->type_name("NUMBER")
      ->group(group::kSea);
}

// The texts of --wind-speed and --wind-from were checked as the numbers of a table of winds.
void ReadAgain(const CLI::Option* option, std::optional<double>& value) {
  if (option != nullptr && !option->empty()) value = ParseDouble(option->results().back());
}

// Values that the ranges of a sea leave out.
absl::Status CheckWind(const ToldSea& sea) {
  for (const auto& each : kSeaNumbers) {
    const std::optional<double>& value = sea.*each.field;
    if (!value.has_value() || (*value >= each.least && *value <= each.greatest)) continue;
    return UsageError(absl::StrCat(std::string(each.flag), " is ", *value, "; give ",
                                   RangeText(each.least, each.greatest, each.unit)));
  }
  return absl::OkStatus();
}

}  // namespace

void AddSeaOptions(CLI::App& command, SeaOptions& options) {
  options.wind_speed = command.get_option("--wind-speed");
  options.wind_from = command.get_option("--wind-from");
  const auto text = [&](const char* flag, std::optional<std::string>& value, const char* type,
                        const char* what, const char* description) {
    return command.add_option(flag, value, description)
        ->type_name(type)
        ->check(NotEmpty(what))
        ->group(group::kSea);
  };
  text("--survey", options.survey, "FILE.toml", "file",
       "What is known of the survey, as TOML: sensor, trajectory, surface, sea, water, datum, output "
       "(docs/budget.md)");
  text("--sea", options.flags.file, "FILE", "file",
       "Spectra or heights of the waves: NDBC, WAVEWATCH III, SWAN or CSV; several records are interpolated "
       "to the "
       "time of each pulse");
  text("--sea-time", options.flags.time, "TIME", "time",
       "The instant of the file for all pulses, UTC, such as 2020-06-08T03:50Z");
  text("--sea-place", options.flags.place, "NAME|LAT,LON", "place",
       "The place of the file, if it has several: its name, or the nearest to a latitude and longitude");
  for (const auto& number : kSeaNumbers)
    if (!number.help.empty()) AddNumberOf(command, number, options.flags);
  command
      .add_option(
          "--tail", options.flags.tail,
          "Waves shorter than the file resolves: the wind's, from the level of the resolved ones by relax "
          "(default), wind or level; or none")
      ->type_name("relax|wind|level|none")
      ->check(OneOf({kTailRules.begin(), kTailRules.end()}))
      ->group(group::kSea);
  for (const auto& number : kWaveNumbers) AddNumberOf(command, number, options.waves);
  command
      .add_option("--spreading", options.waves.spreading,
                  "How directions spread: narrower at the peak than above it (default)")
      ->type_name(std::string(kMitsuyasu))
      ->check(OneOf({std::string(kMitsuyasu)}))
      ->group(group::kSea);
  command
      .add_option_function<std::vector<std::string>>(
          "--swell",
          [&options](const std::vector<std::string>& texts) {
            for (const std::string& each : texts) {
              const absl::StatusOr<JonswapWaves> swell = ParseSwell(each);
              if (!swell.ok()) throw CLI::ValidationError("--swell", std::string(swell.status().message()));
              options.flags.waves.push_back(*swell);
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

absl::StatusOr<SurveyDescription> SurveyOf(const SeaOptions& options) {
  if (!options.survey.has_value()) return SurveyDescription();
  return ReadSurvey(*options.survey);
}

absl::StatusOr<ToldSea> ToldBy(const SeaOptions& options, const SurveyDescription& survey) {
  ToldSea flags = options.flags;
  ReadAgain(options.wind_speed, flags.wind_speed);
  ReadAgain(options.wind_from, flags.wind_from);
  bool has_waves = options.waves.spreading.has_value();
  for (const auto& each : kWaveNumbers) has_waves |= (options.waves.*each.field).has_value();
  if (has_waves) {
    if (const std::string problem = ProblemOf(options.waves, "--"); !problem.empty())
      return UsageError(problem);
    flags.waves.insert(flags.waves.begin(), WavesOf(options.waves));
  }
  const ToldSea sea = options.survey.has_value() ? Together(flags, survey.sea.value_or(ToldSea())) : flags;
  if (absl::Status status = CheckSea(sea); !status.ok()) return status;
  if (sea.has_waves())
    if (absl::Status status = CheckWind(sea); !status.ok()) return status;
  return sea;
}

absl::Status TakeWind(const ToldSea& sea, FixedCoordinates& coordinates) {
  if (sea.has_waves()) {
    if (!coordinates[Index(AxisId::kFetch)].has_value()) return absl::OkStatus();
    return UsageError(
        "--fetch has no effect with --sea or --hs (only tables of winds have a fetch); leave it out");
  }
  std::optional<float>& wind_speed = coordinates[Index(AxisId::kWindSpeed)];
  if (!wind_speed.has_value() && sea.wind_speed.has_value()) wind_speed = static_cast<float>(*sea.wind_speed);
  return absl::OkStatus();
}

absl::Status TakeWind(const ToldSea& sea, FixedInputs& inputs) {
  inputs.any_sea = sea.has_waves();
  std::optional<float>& wind_from = inputs[PulseInput::kWindFrom];
  if (inputs.any_sea) {
    inputs[PulseInput::kWindSpeed] = wind_from = std::nullopt;
  } else if (!wind_from.has_value() && sea.wind_from.has_value()) {
    wind_from = static_cast<float>(*sea.wind_from);
  }
  return TakeWind(sea, inputs.coordinates);
}

absl::StatusOr<Answerer> Answerer::Open(const ToldSea& sea, const SourceOptions& options) {
  Answerer answerer;
  if (!sea.has_waves()) {
    absl::StatusOr<std::unique_ptr<UncertaintySource>> table = OpenSource(options);
    if (!table.ok()) return table.status();
    answerer.table_ = *std::move(table);
    return answerer;
  }
  absl::StatusOr<std::unique_ptr<SeaSources>> sources = OpenSeaSources(options);
  if (!sources.ok()) return sources.status();
  absl::StatusOr<SeaTimeline> timeline = SeaTimeline::Open(sea);
  if (!timeline.ok()) return timeline.status();
  answerer.timeline_ = std::make_shared<const SeaTimeline>(*std::move(timeline));
  absl::StatusOr<std::unique_ptr<SeaAnswers>> seas =
      SeaAnswers::Open(answerer.timeline_, *std::move(sources));
  if (!seas.ok()) return seas.status();
  answerer.seas_ = *std::move(seas);
  return answerer;
}

std::string Answerer::ErrorNote() const {
  if (seas_ == nullptr) return InterpolationErrorNote(table_->table());
  return "standard errors are the sea's own: the sampling of its spectrum, and half the difference between "
         "the tail "
         "rules wind and level";
}

nlohmann::ordered_json Answerer::SeaJson() const {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  if (seas_ != nullptr)
    json["sea"] = SeasJson(*timeline_, timeline_->fixed().first, timeline_->fixed().second);
  return json;
}

std::string Answerer::SeaText() const {
  std::string text;
  if (seas_ == nullptr) return text;
  for (const std::string& note : SeasNotes(*timeline_, timeline_->fixed().first, timeline_->fixed().second))
    absl::StrAppend(&text, "\n  ", note);
  return text;
}

absl::Status Answerer::CheckOneTime(const std::string& command) const {
  if (timeline_ == nullptr || !timeline_->by_time()) return absl::OkStatus();
  return UsageError(absl::StrCat(command, ": ", *timeline_->settings().file, " has ", timeline_->size(),
                                 " records ", SpanText(*timeline_),
                                 " (pulses have no time here); choose one by --sea-time, such as ",
                                 SeaTimeText(timeline_->end())));
}

}  // namespace albtpu::client
