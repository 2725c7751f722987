// The answer for one pulse, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "absl/status/statusor.h"
#include "annotate/answers/batch.h"
#include "annotate/csv/csv_pulses.h"

namespace albtpu::programs {

struct PulseAnswer {
  annotate::FixedCoordinates pulse;
  bool azimuth_from_north = false;
  annotate::AnswerStyle style;
  annotate::AnswerBatch stated;  // All cells, in the style; one answer.
  annotate::AnswerBatch p95;     // THU, TVU and best order, at 95 %; one answer.
};

// All axes that the source needs must be given. `azimuth_from_north`: not from downwind.
absl::StatusOr<PulseAnswer> AskPulse(const annotate::FixedCoordinates& pulse, annotate::AnswerStyle style,
                                     const annotate::AnswerSource& source, bool azimuth_from_north = false);

// Lines with units, coverage, the table, its interpolation error and every order of S-44; for a pulse out of domain,
// the range that the table covers. `sea` are lines about the sea, each after a line feed; empty for a table of winds.
std::string PulseText(const PulseAnswer& answer, const client::TableSummary& table, const std::string& sea = "");

// One flat object and a newline: the coordinates by the names of the axes, the columns of AnswerCells, then
// `azimuth_absent`, `table`, `version`, `digest`, `coverage` (2sigma or p95), and of each quantity but the biases
// `*_interpolation_error_rms` and `*_interpolation_error_percentile_99` (fractions). Null where there is no number; so
// is the fetch of a fully developed sea. Over any sea wind_speed and fetch are null, and the members of `sea` follow.
std::string PulseJson(const PulseAnswer& answer, const client::TableSummary& table, const nlohmann::ordered_json& sea);

}  // namespace albtpu::programs
