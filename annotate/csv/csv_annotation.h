// Copies a CSV file of pulses and appends the uncertainty of each pulse.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/answers/batch.h"
#include "annotate/answers/uncertainty_summary.h"
#include "annotate/csv/csv_pulses.h"
#include "annotate/run/file_progress.h"
#include "annotate/totals/total_summary.h"
#include "formats/files/file_access.h"

namespace albtpu::annotate {

struct AnnotatedCsv {
  std::uint64_t input_bytes = 0;
  UncertaintySummary summary;
  TotalSummary totals;           // Empty without a total.
  bool took_divergence = false;  // of CsvTotal
  formats::CsvDialect dialect;   // Of input and output.
  OutputFile file;               // Complete; Commit() gives it its name.
};

// The settings of totals for the pulses of a file. The divergence of the sensor is that of a file that has neither
// footprints nor divergences.
struct CsvTotal {
  TotalPlan plan;
  bool details = false;       // Append contributions and covariance, too.
  std::string wind_spectrum;  // Of the table of winds, for the height of the waves; empty over any sea.
};

// The flags of a total as they are bound with the columns of a file. A flag determines an axis only together with the
// other input of its way. The divergence of the sensor [mrad], if it has one, is used where a file has neither
// footprints nor divergences.
FixedInputs OfTotal(FixedInputs fixed, std::optional<double> divergence, const formats::CsvRecord& header);

// Columns are found by name, in any order: a column with the name of a PulseInput has its numbers; all other columns
// are ignored. Every record is copied byte for byte, including line ending, quotes and byte order mark, and followed by
// the columns of `AnswerCells`, or with `total` those of TotalCells, in the dialect of the file; a last line without a
// line ending gets that of the header. Blank lines are copied. An empty cell in `fetch` means a fully developed sea, in
// `azimuth`, `beam_azimuth` or `wind_from` no azimuth. Reading, querying and writing overlap; memory does not grow with
// the file.
//
// Fails and writes nothing when a column is missing and has no fixed number, occurs twice, also has a fixed number
// (IsUsageError), gives a coordinate that is given in another way, too (CheckWays), or has the name of a column to be
// appended; when the number of cells in a record differs from the header; when a coordinate is not a number; or when
// the input is modified meanwhile. Messages name line and column.
absl::StatusOr<AnnotatedCsv> AnnotateCsv(const std::filesystem::path& input, const std::filesystem::path& output,
                                         Existing existing, const FixedInputs& fixed, AnswerStyle style,
                                         const AnswerSource& source, FileProgress& progress,
                                         const CsvTotal* total = nullptr);

// total_thu, total_tvu, with details the contributions and the covariance of the total (axes north, east, down), then
// the biases and `outcome`; with an order of S-44 also `s44_order_met`.
std::vector<std::string> TotalCells(const CsvTotal& total, const AnswerStyle& style);

}  // namespace albtpu::annotate
