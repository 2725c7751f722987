// The answer for one pulse, for people and for programs.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "service/client/uncertainty_source.h"
#include "survey/answers/batch.h"
#include "survey/csv/csv_pulses.h"

namespace albtpu::client {

struct PulseAnswer {
  FixedCoordinates pulse;
  AnswerStyle style;
  AnswerBatch stated;  // All cells, in the style; one answer.
  AnswerBatch p95;     // THU, TVU and best order, at 95 %; one answer.
};

// All axes but fetch and azimuth must be given.
absl::StatusOr<PulseAnswer> AskPulse(const FixedCoordinates& pulse, AnswerStyle style,
                                     UncertaintySource& source);

// Lines with units, coverage, the table, its interpolation error and every order of S-44; for a pulse out of domain,
// the range that the table covers.
std::string PulseText(const PulseAnswer& answer, const TableSummary& table);

// One flat object and a newline: the coordinates by the names of the axes, the columns of AnswerCells, then
// `azimuth_absent`, `table`, `version`, `digest`, `coverage` (2sigma or p95), and of each quantity but the biases
// `*_interpolation_error_rms` and `*_interpolation_error_percentile_99` (fractions). Null where there is no number; so
// is the fetch of a fully developed sea.
std::string PulseJson(const PulseAnswer& answer, const TableSummary& table);

}  // namespace albtpu::client
