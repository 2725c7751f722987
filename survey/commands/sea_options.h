// The flags that say which sea there is, and what answers for it.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "command_line/cli_fwd.h"
#include "survey/answers/batch.h"
#include "survey/commands/source_options.h"
#include "survey/csv/pulse_inputs.h"
#include "survey/description/survey_description.h"
#include "survey/seas/sea_answers.h"
#include "survey/seas/told_sea.h"

namespace albtpu::client {

struct SeaOptions {
  std::optional<std::string> survey;  // --survey
  ToldSea flags;
  ToldWaves waves;  // --hs and the like
  // --wind-speed and --wind-from, whose texts are read again in double precision for a sea.
  const CLI::Option *wind_speed = nullptr, *wind_from = nullptr;
};

// Adds all flags but --wind-speed and --wind-from, which `command` has. `options` must live as long as `command`.
void AddSeaOptions(CLI::App& command, SeaOptions& options);

// What the file of --survey says; nothing without one.
absl::StatusOr<SurveyDescription> SurveyOf(const SeaOptions& options);

// What flags and survey file say of the sea together. Fails where they contradict themselves or each other.
absl::StatusOr<ToldSea> ToldBy(const SeaOptions& options, const SurveyDescription& survey);

// Where no waves are told: what the survey file says of the wind and no flag does. With waves the wind is not of the
// pulses; UsageError if a fetch is given, which such a sea has not.
absl::Status TakeWind(const ToldSea& sea, FixedCoordinates& coordinates);
absl::Status TakeWind(const ToldSea& sea, FixedInputs& inputs);

// What answers the pulses of a command: a table, or the sea.
class Answerer {
 public:
  // Opens a table, unless `sea` has waves. UsageError if both are given.
  static absl::StatusOr<Answerer> Open(const ToldSea& sea, const SourceOptions& options);

  AnswerSource source() { return seas_ != nullptr ? seas_->source() : AnswerSource(*table_); }
  // Null where a table answers.
  std::shared_ptr<const SeaTimeline> timeline() const { return timeline_; }
  SeaAnswers* seas() { return seas_.get(); }

  // What the errors of its numbers are, for the user.
  std::string ErrorNote() const;

  // Which sea it is, for a summary ({"sea": ...} or {}) and for the user, lines indented by two blanks. Of a sea for
  // all pulses.
  nlohmann::ordered_json SeaJson() const;
  std::string SeaText() const;

  // UsageError if the sea goes by times that the pulses of `command` do not have.
  absl::Status CheckOneTime(const std::string& command) const;

 private:
  std::unique_ptr<UncertaintySource> table_;
  std::shared_ptr<const SeaTimeline> timeline_;
  std::unique_ptr<SeaAnswers> seas_;
};

}  // namespace albtpu::client
