// Copies a CSV file of pulses and appends the uncertainty of each pulse.
#pragma once

#include <filesystem>

#include "absl/status/statusor.h"
#include "survey/answers/batch.h"
#include "survey/answers/uncertainty_summary.h"
#include "survey/csv/csv_pulses.h"
#include "survey/files/file_progress.h"
#include "survey/files/output_file.h"

namespace albtpu::client {

struct AnnotatedCsv {
  std::uint64_t input_bytes = 0;
  UncertaintySummary summary;
  OutputFile file;  // Complete; Commit() gives it its name.
};

// Columns are found by name, in any order: a column with the name of a PulseInput has its numbers; all other columns
// are ignored. Every record is copied byte for byte, including line ending, quotes and byte order mark, and followed by
// the columns of `AnswerCells`; a last line without a line ending gets that of the header. Blank lines are copied. An
// empty cell in `fetch` means a fully developed sea, in `azimuth`,
// `beam_azimuth` or `wind_from` no azimuth. Reading, querying and writing overlap;
// memory does not grow with the file.
//
// Fails and writes nothing when a column is missing and has no fixed number, occurs twice, also has a fixed number
// (IsUsageError), gives a coordinate that is given in another way, too (CheckWays), or has the name of a column to be
// appended; when the number of cells in a record differs from the header; when a coordinate is not a number; or when
// the input is modified meanwhile. Messages name line and column.
absl::StatusOr<AnnotatedCsv> AnnotateCsv(const std::filesystem::path& input,
                                         const std::filesystem::path& output, Existing existing,
                                         const FixedInputs& fixed, AnswerStyle style,
                                         const AnswerSource& source, FileProgress& progress);

}  // namespace albtpu::client
