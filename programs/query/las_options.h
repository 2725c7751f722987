// The options of `albtpu-query las`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/las/las_annotation.h"
#include "annotate/run/file_jobs.h"
#include "config/survey_draft.h"
#include "formats/las/las_reader.h"
#include "programs/command_line/cli_fwd.h"
#include "programs/query/beam_options.h"
#include "programs/query/source_options.h"
#include "programs/query/survey_flags.h"

namespace albtpu::programs {

struct LasOptions {
  annotate::FileOptions files;
  SurveyFlags flags;
  BeamOptions beams;
  bool replace = false;
  std::string csv;                         // --csv; empty: none
  std::optional<formats::LasKind> format;  // --format
  Existing existing = Existing::kKeep;
  SourceOptions source;
  annotate::AnswerStyle style;
};

// `options` must live as long as `command`.
void AddLasOptions(CLI::App& command, LasOptions& options);

// ".las", ".laz"
std::vector<std::string> LasExtensions();

// What flags and survey file give together; a scanner or one incidence overrides the trajectory of the file.
absl::StatusOr<config::SurveySettings> SettingsOf(const LasOptions& options);

// All that these options and settings leave open, before any file is read. Fails where the sensor is unknown.
absl::StatusOr<std::vector<config::OpenDecision>> OpenDecisionsOf(const LasOptions& options,
                                                                  const config::SurveySettings& settings);

// IsUsageError if something needed is missing, is given in two ways or has no effect.
absl::StatusOr<annotate::LasAnnotation> Annotation(const LasOptions& options, const config::SurveySettings& settings);

// Whether the points are wanted as CSV only: neither OUT nor --output-dir says where LAS goes.
bool IsCsvAlone(const LasOptions& options);

// The files with their outputs; of a job of CSV alone, `output` is the CSV.
absl::StatusOr<std::vector<annotate::Job>> JobsOf(const LasOptions& options);

// The kind that --format or the name of a single output asks for; absent: that of each input. IsUsageError when the two
// contradict each other.
absl::StatusOr<std::optional<formats::LasKind>> OutputKind(const LasOptions& options);

// Annotation, sea and --format as a summary states them.
nlohmann::ordered_json Parameters(const annotate::LasAnnotation& annotation, const config::SeaSettings& sea,
                                  std::optional<formats::LasKind> format);

}  // namespace albtpu::programs
