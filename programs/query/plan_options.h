// The flags of `albtpu-query plan`, and a check that each of them has an effect.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "config/sea_settings.h"
#include "programs/command_line/cli_fwd.h"
#include "programs/query/source_options.h"
#include "programs/query/survey_flags.h"
#include "tables/file/existing.h"

namespace albtpu::programs {

struct PlanOptions {
  SurveyFlags flags;
  SourceOptions source;
  std::optional<double> divergence;  // mrad
  double altitude = 400, incidence = 20;
  std::vector<double> altitudes = {200, 300, 400, 500, 600, 700, 800};
  std::vector<double> incidences = {0, 5, 10, 15, 20, 25};
  std::vector<double> kds = {0.06, 0.08, 0.1, 0.15, 0.2, 0.3, 0.4};
  std::vector<double> winds = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  std::vector<double> heights = {0.25, 0.5, 0.75, 1, 1.5, 2, 2.5, 3};  // Of waves, m.
  std::string order = "1a", output;
  bool json = false, no_page = false, kds_given = false, winds_given = false, heights_given = false;
  Existing existing = Existing::kKeep;
};

// `options` must live as long as `command`.
void AddPlanOptions(CLI::App& command, PlanOptions& options);

// UsageError where a flag has no effect with the sea of flags and survey file together.
absl::Status CheckPlannedSeas(const PlanOptions& options, const config::SeaSettings& sea);

}  // namespace albtpu::programs
