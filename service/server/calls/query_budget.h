// Queries the whole budget of pulses in columns, for `QueryBudget`: reads its options and the aircraft, and answers.
#pragma once

#include <array>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "albtpu/v1/budget.pb.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "budget/query/budget_query.h"
#include "service/column_message.h"
#include "service/server/calls/query_columns.h"
#include "service/server/calls/sea_request.h"
#include "service/server/observe/metric_collectors.h"

namespace albtpu::server {

// Reads the options and the aircraft of a request for the whole budget.

// INVALID_ARGUMENT with the paths of wrong fields, which begin with `options`. The coverage is that of the caller.
absl::StatusOr<BudgetOptions> ReadBudgetOptions(const v1::BudgetOptions& options);

// The columns of the aircraft, in the order of kAircraftInputs. The result refers to `aircraft`.
std::array<RequestColumn, kAircraftInputs.size()> ColumnsOf(const v1::AircraftColumns& aircraft);

// Adds the fields of a QueryBudgetResponse to `response`, writes the answers directly into it, and counts them in
// `tally`. Fails as documented for `QueryBudget`.
absl::Status QueryBudget(AnswerSources& sources, const v1::QueryBudgetRequest& request, ColumnMessage& response,
                         OutcomeTally& tally);

}  // namespace albtpu::server
