// The interpolation error of a table. It was measured when the table was made, at random pulses all over the table, and
// is in its attributes `interpolation_error_*` (tables/FORMAT.md).
#pragma once

#include <string>
#include <vector>

#include "service/client/uncertainty_source.h"
#include "tables/schema.h"

namespace albtpu::annotate {

// Of one quantity. Errors are fractions of the directly computed value.
struct InterpolationError {
  Quantity quantity;
  double rms, percentile_99;
};

// Of each quantity for which the table states it. Empty if it is not known, as for published tables.
std::vector<InterpolationError> InterpolationErrors(const client::TableSummary& table);

// "0.28 % rms, 1.1 % at the 99th percentile".
std::string Text(const InterpolationError& error);

// All of them in one line, for a note beside the output of many pulses.
std::string InterpolationErrorNote(const client::TableSummary& table);

}  // namespace albtpu::annotate
