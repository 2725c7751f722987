// Queries the whole budget of pulses in columns, for `QueryBudget`.
#pragma once

#include "absl/status/status.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/column_message.h"
#include "service/server/calls/answer_sources.h"
#include "service/server/observe/outcome_tally.h"

namespace albtpu::server {

// Adds the fields of a QueryBudgetResponse to `response`, writes the answers directly into it, and counts them in
// `tally`. Fails as documented for `QueryBudget`.
absl::Status QueryBudget(AnswerSources& sources, const v1::QueryBudgetRequest& request, ColumnMessage& response,
                         OutcomeTally& tally);

}  // namespace albtpu::server
