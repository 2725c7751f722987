#include "survey/commands/total_options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "command_line/checks.h"
#include "survey/commands/options.h"
#include "survey/exit_status.h"
#include "survey/number_text.h"

namespace albtpu::client {

void AddTotalOptions(CLI::App& command, TotalOptions& options) {
  command
      .add_option("--sensor", options.sensor,
                  "The lidar, by name or file (albtpu-query sensors): give the total uncertainty, with the "
                  "air side, the "
                  "location of the surface and the datum, instead of the share of the sea surface")
      ->type_name("NAME|FILE.toml")
      ->check(NotEmpty("sensor"))
      ->group(group::kTotal);
  command
      .add_option(
          "--surface-located", options.located,
          "How the points' processing found the water surface: by the return of each pulse, a local model of "
          "returns (default with --water-classes) or a level (default without)")
      ->type_name("pulse|local|level")
      ->check(OneOf({kWaysToLocate.begin(), kWaysToLocate.end()}))
      ->group(group::kTotal);
  AddNumber(command, "--datum-sigma", Sign::kNotNegative,
            "Standard deviation of the vertical datum [m]; 0 for ellipsoidal heights", options.datum_sigma)
      ->group(group::kTotal);
  command
      .add_option("--water-column", options.water_column,
                  "none: leave out the share of the water column, which cannot be computed yet")
      ->type_name("none")
      ->check(OneOf({"none"}))
      ->group(group::kTotal);
}

void AddTriple(CLI::App& command, const std::string& flag, const std::string& type,
               const std::string& description, std::optional<std::array<double, 3>>& value) {
  command
      .add_option_function<std::string>(
          flag,
          [flag, type, &value](const std::string& text) {
            const std::vector<std::string> parts = absl::StrSplit(text, ',');
            std::array<double, 3> numbers = {};
            bool good = parts.size() == numbers.size();
            for (std::size_t i = 0; good && i < numbers.size(); ++i) {
              const std::optional<double> number = ParseDouble(parts[i]);
              good = number.has_value() && std::isfinite(*number);
              numbers[i] = number.value_or(0);
            }
            if (!good)
              throw CLI::ValidationError(flag, absl::StrCat("is '", text, "'; give three numbers: ", type));
            value = numbers;
          },
          description)
      ->type_name(type)
      ->group(group::kTotal);
}

SurveyDescription Together(const TotalOptions& flags, SurveyDescription survey) {
  const auto take = [](auto& section, auto field, const auto& value) {
    if (!value.has_value()) return;
    if (!section.has_value()) section.emplace();
    (*section).*field = *value;
  };
  take(survey.sensor, &ToldSensor::name, flags.sensor);
  take(survey.surface, &ToldSurface::located, flags.located);
  take(survey.datum, &ToldDatum::sigma, flags.datum_sigma);
  if (flags.water_column.has_value()) {
    if (!survey.water.has_value()) survey.water.emplace();
    survey.water->without_column = true;
  }
  return survey;
}

absl::Status CheckTotalFlags(const TotalOptions& flags, const SurveyDescription& survey) {
  if (WantsTotal(survey)) return absl::OkStatus();
  const struct {
    const char* flag;
    bool given;
  } flags_of_total[] = {{"--surface-located", flags.located.has_value()},
                        {"--datum-sigma", flags.datum_sigma.has_value()},
                        {"--water-column", flags.water_column.has_value()}};
  for (const auto& flag : flags_of_total) {
    if (flag.given)
      return UsageError(
          absl::StrCat(flag.flag, " has no effect without --sensor; give both or none of them"));
  }
  if (survey.sigma.has_value())
    return UsageError("[sigma] has no effect without a sensor; give [sensor] name, or --sensor");
  return absl::OkStatus();
}

void TakeStyle(const SurveyDescription& survey, AnswerStyle& style) {
  if (!survey.output.has_value()) return;
  if (!style.coverage_given && survey.output->coverage.has_value())
    style.coverage = *FindCoverage(*survey.output->coverage);
  if (!style.s44_order.has_value() && survey.output->s44_order.has_value())
    style.s44_order = FindS44Order(*survey.output->s44_order);
}

}  // namespace albtpu::client
