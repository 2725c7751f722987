// A CSV file of pulses, repeated with the uncertainty of each.
#pragma once

#include <filesystem>

#include "absl/status/statusor.h"
#include "service/client/uncertainty_source.h"
#include "survey/answers/answer_style.h"
#include "survey/answers/uncertainty_summary.h"
#include "survey/csv/csv_pulses.h"
#include "survey/files/output_file.h"
#include "survey/files/progress.h"

namespace albtpu::client {

struct AnnotatedCsv {
  std::uint64_t input_bytes = 0;
  UncertaintySummary summary;
  OutputFile file;  // Whole, but not under its name before Commit().
};

// Columns are found by name: those named as an axis hold that coordinate, in any order; all others are of no
// concern. Every record is repeated byte for byte, line ending, quotes and byte order mark included, with the
// columns of `AnswerCells` behind it; a last line without an ending gets that of the header. Blank lines are
// repeated. An empty cell under `fetch` is a fully developed sea, under `azimuth` no azimuth. Reads, asks and
// writes at the same time; memory does not grow with the file.
//
// Fails, writing nothing, when a column is missing that has no fixed coordinate, stands twice, has a fixed
// coordinate as well (IsUsageError), or has the name of a column that is to be appended; when a record has
// another number of cells than the header; when a coordinate is not a number; when somebody writes to the
// input meanwhile. Messages name line and column.
absl::StatusOr<AnnotatedCsv> AnnotateCsv(const std::filesystem::path& input,
                                         const std::filesystem::path& output, Existing existing,
                                         const FixedCoordinates& fixed, AnswerStyle style,
                                         UncertaintySource& source, Progress& progress);

}  // namespace albtpu::client
