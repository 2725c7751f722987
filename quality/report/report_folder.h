// The folder of a report or a plan: its files, which appear together, its page, and the verdict for the terminal.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "quality/annotated/annotated_points.h"
#include "quality/report/survey_report.h"
#include "tables/file/output_folder.h"

namespace albtpu::quality {

// The names of the files in the folder.
inline constexpr std::array<std::string_view, 3> kReportFiles = {"report.json", "grid.nc", "report.html"};
inline constexpr std::array<std::string_view, 2> kPlanFiles = {"plan.json", "plan.html"};

// Whether `folder` has the complete report of these files with these options, which are not newer than it.
bool HasReport(const std::filesystem::path& folder, const std::vector<AnnotatedLasFile>& files,
               const ReportOptions& options, bool with_page);

// Writes a report in a hidden folder and gives its files their names when all are complete, the page last. The grid is
// freed before the page is drawn.
absl::Status WriteReport(SurveyReport report, bool with_page, const std::filesystem::path& folder);

// Removes a folder that was not there when it was constructed, if nothing was written into it.
class NewFolder {
 public:
  explicit NewFolder(std::filesystem::path folder)
      : folder_(std::move(folder)), was_there_(std::filesystem::exists(folder_)) {}
  ~NewFolder() {
    std::error_code not_empty;
    if (!was_there_) std::filesystem::remove(folder_, not_empty);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

 private:
  std::filesystem::path folder_;
  bool was_there_;
};

// The same for plan.json and plan.html of a planned survey.
absl::Status WritePlan(const nlohmann::ordered_json& plan, bool with_page, const std::filesystem::path& folder);

// The page of a report or a plan, which the Python package draws: python3 -m albtpu.report FOLDER.

// FailedPrecondition where Python or one of the packages that draw the page is missing, with what to install.
absl::Status CheckPageCanBeDrawn();

// Makes report.html in `folder` from report.json and grid.nc in it, or plan.html from plan.json.
absl::Status DrawPage(const std::filesystem::path& folder);

// What is printed of a report, SurveyReport::json.

// The verdict in some lines, for the terminal.
std::string ReportText(const nlohmann::ordered_json& report);

// The text of report.json.
std::string JsonText(const nlohmann::ordered_json& report);

}  // namespace albtpu::quality
