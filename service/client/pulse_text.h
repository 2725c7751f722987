// The answer for one pulse, for people and for programs.
#pragma once

#include <string>

#include "service/client/answer_columns.h"
#include "service/client/uncertainty_source.h"
#include "tables/interpolation.h"

namespace albtpu::client {

// Lines with units, coverage, the table and every order of S-44; for a pulse out of domain, the range that
// there is.
std::string PulseText(const Pulse& pulse, const PulseUncertainty& two_sigma, AnswerStyle style,
                      const TableSummary& table);

// One flat object and a newline: the coordinates by the names of the axes, the columns of AnswerColumns, then
// `azimuth_absent`, `table`, `version`, `digest` and `coverage` (2sigma or p95). Null where there is no
// number; so is the fetch of a fully developed sea.
std::string PulseJson(const Pulse& pulse, const PulseUncertainty& two_sigma, AnswerStyle style,
                      const TableSummary& table);

}  // namespace albtpu::client
