// What is wrong in a query of the budget.
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "budget/query/budget_query.h"
#include "tables/schema.h"

namespace albtpu {

// What is wrong in `options`: a standard deviation that is not 0 to kGreatestBudgetNumber, a lever arm beyond it, an
// index that is not 1 to 2.
struct OptionError {
  std::string field;    // As in budget.proto: "errors.position.north".
  std::string problem;  // Names the field.
};
std::vector<OptionError> FindErrors(const BudgetOptions& options);

// InvalidArgument: an error in `options`, or a column of a length that is neither one nor the number of pulses, or that
// is empty although required, of the aircraft or for a table of kind `schema`.
absl::Status CheckQuery(const TableSchema& schema, const BudgetPulses& pulses, const BudgetOptions& options);

}  // namespace albtpu
