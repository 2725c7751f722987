// The survey file: what is known of a survey beside its points, as TOML. docs/survey.md has its keys.
#pragma once

#include <filesystem>
#include <string_view>

#include "absl/status/statusor.h"
#include "config/survey_settings.h"

namespace albtpu::config {

// InvalidArgument "line 3: ..." at the first problem: what is no TOML, a key that is unknown, of another type or out of
// range, keys that contradict each other, and waves that are incomplete. `folder` is that of relative paths.
absl::StatusOr<SurveySettings> ParseSurvey(std::string_view text, const std::filesystem::path& folder);

// The same of a file, whose path begins the message.
absl::StatusOr<SurveySettings> ReadSurvey(const std::filesystem::path& path);

}  // namespace albtpu::config
