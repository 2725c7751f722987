// The survey file: what is known of a survey beside its points, as TOML.
//
//     [sea]
//     wind_speed = 6.5                    # m/s at 10 m; 0 is a calm
//     wind_from = 225                     # degree, true
//     water_depth = 12                    # m; absent: deep
//     tail = "relax"                      # "wind", "level", "none"
//     tail_from = 0.95                    # Hz; absent: up to where the waves can be trusted
//     [[sea.waves]]                       # any number; or: file = "41010.data_spec"
//     hs = 0.42                           # m
//     tp = 2.7                            # s
//     gamma = 3.3
//     waves_from = 225                    # degree, true
//     spreading = "mitsuyasu"             # or spread = 18, degree
//
// With a file: time = "2020-06-08T03:50Z" (absent: by the time of each pulse), place, longest_gap (h),
// anemometer_height (m). Its path counts from the folder of the survey file.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "absl/status/statusor.h"
#include "survey/seas/told_sea.h"

namespace albtpu::client {

struct SurveyDescription {
  std::optional<ToldSea> sea;  // [sea]
};

// InvalidArgument "line 3: ..." at the first problem: what is no TOML, a key that is unknown, of another type or out of
// range, and waves that are incomplete. `folder` is that of relative paths.
absl::StatusOr<SurveyDescription> ParseSurvey(std::string_view text, const std::filesystem::path& folder);

// The same of a file, whose path begins the message.
absl::StatusOr<SurveyDescription> ReadSurvey(const std::filesystem::path& path);

}  // namespace albtpu::client
