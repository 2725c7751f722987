// The flags that stand for keys of the survey file, and the settings that both give together.
#pragma once

#include <array>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/answers/batch.h"
#include "annotate/csv/pulse_inputs.h"
#include "annotate/seas/sea_timeline.h"
#include "config/survey_settings.h"
#include "programs/command_line/cli_fwd.h"

namespace albtpu::programs {

struct SurveyFlags {
  std::optional<std::string> survey;  // --survey
  config::SurveySettings settings;    // what the other flags give
};

// Each adds flags under a heading of --help. `flags` must live as long as `command`.
void AddFlags(CLI::App& command, std::initializer_list<const char*> names, const char* heading, SurveyFlags& flags);
// --survey, those of [sea] and [[sea.waves]], but for some, and --water-index.
void AddSeaFlags(CLI::App& command, SurveyFlags& flags, std::span<const std::string_view> without);
// --sensor and those that go with it on all commands.
void AddTotalFlags(CLI::App& command, SurveyFlags& flags);
// --coverage, --s44-order and --standard-errors.
void AddStyleFlags(CLI::App& command, SurveyFlags& flags, annotate::AnswerStyle& style);

// The flags of `sea`, `pulse` and `plan` that the survey file has for the other commands.
inline constexpr std::array<std::string_view, 5> kRareSeaFlags = {"--gamma", "--tail", "--tail-from", "--sea-gap",
                                                                  "--anemometer-height"};

// What flags and survey file give together. Fails where what they say of the sea contradicts itself or has no effect.
absl::StatusOr<config::SurveySettings> SettingsOf(const SurveyFlags& flags);

// [project] by its keys, without those that are not given.
nlohmann::ordered_json ProjectJson(const config::ProjectSettings& project);

// UsageError where a flag or [sigma] needs a sensor, and none is named.
absl::Status CheckTotalFlags(const SurveyFlags& flags, const config::SurveySettings& settings);

// The coverage and the order of the settings.
void TakeStyle(const config::OutputSettings& output, annotate::AnswerStyle& style);

// The wind and the fetch of the settings, if a table of winds answers. With waves the wind is not of the pulses.
void TakeWind(const config::SeaSettings& sea, annotate::FixedInputs& inputs);
// The same, whatever answers.
void StateWind(const config::SeaSettings& sea, annotate::FixedInputs& inputs);

// Of commands that read annotated files: the waves that they were annotated with, given again. Absent where none are
// given. Of a wind all is in the summaries: its flags are taken beside waves alone, which have no fetch.
inline constexpr std::array<std::string_view, 1> kOfWindsAlone = {"--fetch"};
absl::StatusOr<std::optional<annotate::SeaTimeline>> GivenSeas(const SurveyFlags& flags,
                                                               const config::SurveySettings& settings);

// The files of the survey, of a sea and of a sensor that flags and settings name, for a check of the outputs.
std::vector<std::filesystem::path> FilesOf(const SurveyFlags& flags, const config::SurveySettings& settings);

}  // namespace albtpu::programs
