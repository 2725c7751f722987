// The options of `albtpu-query las`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "absl/status/statusor.h"
#include "command_line/cli_fwd.h"
#include "survey/commands/beam_options.h"
#include "survey/commands/source_options.h"
#include "survey/commands/survey_flags.h"
#include "survey/files/file_jobs.h"
#include "survey/las/las_annotation.h"
#include "survey/las/las_kind.h"

namespace albtpu::client {

struct LasOptions {
  FileOptions files;
  SurveyFlags flags;
  BeamOptions beams;
  bool replace = false;
  std::optional<LasKind> format;  // --format
  Existing existing = Existing::kKeep;
  SourceOptions source;
  AnswerStyle style;
};

// `options` must live as long as `command`.
void AddLasOptions(CLI::App& command, LasOptions& options);

// What flags and survey file give together; a scanner or one incidence overrides the trajectory of the file.
absl::StatusOr<config::SurveySettings> SettingsOf(const LasOptions& options);

// IsUsageError if something needed is missing, is given in two ways or has no effect.
absl::StatusOr<LasAnnotation> Annotation(const LasOptions& options, const config::SurveySettings& settings);

// The kind that --format or the name of a single output asks for; absent: that of each input. IsUsageError when the two
// contradict each other.
absl::StatusOr<std::optional<LasKind>> OutputKind(const LasOptions& options);

// Annotation, sea and --format as a summary states them.
nlohmann::ordered_json Parameters(const LasAnnotation& annotation, const config::SeaSettings& sea,
                                  std::optional<LasKind> format);

}  // namespace albtpu::client
