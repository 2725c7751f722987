// The page of a report or a plan, which the Python package draws: python3 -m albtpu.report FOLDER.
#pragma once

#include <filesystem>

#include "absl/status/status.h"

namespace albtpu::quality {

// FailedPrecondition where Python or one of the packages that draw the page is missing, with what to install.
absl::Status CheckPageCanBeDrawn();

// Makes report.html in `folder` from report.json and grid.nc in it, or plan.html from plan.json.
absl::Status DrawPage(const std::filesystem::path& folder);

}  // namespace albtpu::quality
