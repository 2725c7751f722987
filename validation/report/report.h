// The report of a validation: CSV files, figures and one page, in a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "validation/report/study.h"

namespace albtpu {

struct ReportOptions {
  std::filesystem::path folder;  // made if it is not there
  std::filesystem::path plots;   // where draw.py is
  std::string made_by;           // a line for the head of the page
  bool overwrite = false;        // files of an earlier report
};

// What would keep a report from being written to options.folder, before the work: something that is in it already
// (AlreadyExists), no parent folder (NotFound), no right to write (PermissionDenied).
absl::Status PrepareReport(const ReportOptions& options);

// Writes summary.csv, one CSV for each table, one SVG for each figure and, last, report.html. All are made in
// a hidden folder first and take their places when all are whole. Returns why figures are missing, if any is.
absl::StatusOr<std::string> WriteReport(const std::vector<Study>& studies, const ReportOptions& options);

}  // namespace albtpu
