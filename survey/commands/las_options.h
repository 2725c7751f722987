// The options of `albtpu-query las`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>

#include "absl/status/statusor.h"
#include "command_line/cli_fwd.h"
#include "survey/commands/beam_options.h"
#include "survey/commands/options.h"
#include "survey/commands/sea_options.h"
#include "survey/commands/total_options.h"
#include "survey/files/file_jobs.h"
#include "survey/las/las_annotation.h"
#include "survey/las/las_kind.h"

namespace albtpu::client {

struct LasOptions {
  FileOptions files;
  std::optional<std::set<int>> classes;
  BeamOptions beams;
  bool details = false;
  bool replace = false;
  std::optional<LasKind> format;  // --format
  Existing existing = Existing::kKeep;
  SeaOptions sea;
  TotalOptions total;
  SourceOptions source;
  AnswerStyle style;
};

// `options` must live as long as `command`.
void AddLasOptions(CLI::App& command, LasOptions& options);

// The options with what the survey file says in place of flags.
LasOptions Together(LasOptions flags, const SurveyDescription& survey);

// IsUsageError if something needed is missing, is given in two ways or has no effect. `options` and `survey` are
// together, and `sea` is what ToldBy() gives.
absl::StatusOr<LasAnnotation> Annotation(const LasOptions& options, const SurveyDescription& survey,
                                         const ToldSea& sea);

// The kind that --format or the name of a single output asks for; absent: that of each input. IsUsageError when the two
// contradict each other.
absl::StatusOr<std::optional<LasKind>> OutputKind(const LasOptions& options);

// Annotation, sea and --format as a summary states them.
nlohmann::ordered_json Parameters(const LasAnnotation& annotation, const ToldSea& sea,
                                  std::optional<LasKind> format);

}  // namespace albtpu::client
