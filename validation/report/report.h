// The report of a validation in a folder: CSV files, figures and one page.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "validation/report/study.h"

namespace albtpu {

struct ReportOptions {
  std::filesystem::path folder;  // of PrepareFolder (tables/file/output_folder.h)
  std::filesystem::path plots;   // the folder of draw.py
  std::string made_by;           // a line at the head of the page
};

// Writes summary.csv, one CSV file for each table, one SVG file for each figure and, last, report.html. They are made
// in a hidden folder and moved into place when all are complete. Returns why figures are missing; empty if none is.
absl::StatusOr<std::string> WriteReport(const std::vector<Study>& studies, const ReportOptions& options);

// The report as one self-contained HTML page, with style, numbers and figures inside.

struct ReportPage {
  std::string made_by;                         // program, version, commit, effort
  std::map<std::string, std::string> figures;  // SVG by name; the page says which ones are missing
  std::string why_figures_are_missing;         // empty if none is
};

std::string HtmlOf(const std::vector<Study>& studies, const ReportPage& page);

}  // namespace albtpu
