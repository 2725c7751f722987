// Reads the options and the aircraft of a request for the whole budget.
#pragma once

#include <array>

#include "absl/status/statusor.h"
#include "albtpu/v1/budget.pb.h"
#include "budget/query/budget_query.h"
#include "service/server/calls/request_columns.h"

namespace albtpu::server {

// INVALID_ARGUMENT with the paths of wrong fields, which begin with `options`. The coverage is that of the caller.
absl::StatusOr<BudgetOptions> ReadBudgetOptions(const v1::BudgetOptions& options);

// The columns of the aircraft, in the order of kAircraftInputs. The result refers to `aircraft`.
std::array<RequestColumn, kAircraftInputs.size()> ColumnsOf(const v1::AircraftColumns& aircraft);

}  // namespace albtpu::server
