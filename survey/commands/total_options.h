// The flags of the total uncertainty, and what a survey file says in place of flags.
#pragma once

#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "command_line/cli_fwd.h"
#include "survey/answers/batch.h"
#include "survey/description/survey_description.h"
#include "survey/totals/plan_total.h"

namespace albtpu::client {

struct TotalOptions {
  std::optional<std::string> sensor;        // --sensor
  std::optional<std::string> located;       // --surface-located
  std::optional<double> datum_sigma;        // --datum-sigma, m
  std::optional<std::string> water_column;  // --water-column none
};

// `options` must live as long as `command`.
void AddTotalOptions(CLI::App& command, TotalOptions& options);

// Three numbers, of the motion of the aircraft at one pulse.
void AddTriple(CLI::App& command, const std::string& flag, const std::string& type,
               const std::string& description, std::optional<std::array<double, 3>>& value);

// The survey file with what flags say in place of it.
SurveyDescription Together(const TotalOptions& flags, SurveyDescription survey);

// Whether a total is asked for: a sensor is named.
inline bool WantsTotal(const SurveyDescription& survey) {
  return survey.sensor.has_value() && survey.sensor->name.has_value();
}

// UsageError where one of these flags is given, and no sensor is named.
absl::Status CheckTotalFlags(const TotalOptions& flags, const SurveyDescription& survey);

// What [output] says and no flag does: coverage and order.
void TakeStyle(const SurveyDescription& survey, AnswerStyle& style);

}  // namespace albtpu::client
