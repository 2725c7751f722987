// Calls of `QueryBudget`, seen from the client.
#pragma once

#include <grpcpp/generic/generic_stub.h>

#include <cstddef>

#include "absl/status/status.h"
#include "albtpu/v1/water.pb.h"
#include "budget/query/budget_query.h"
#include "service/client/column_exchange.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::client {

struct BudgetTask : Task<BudgetOptions, BudgetPulses, BudgetAnswers> {
  const albtpu::v1::WaterState* water = nullptr;  // Null: none, or its columns.
  WaterSummary* summary = nullptr;                // Of the water, if not null.
};

// Queries the pulses from index `begin` on, a few calls at a time, until all are answered or something fails. Sets
// `begin` and fails as QueryByStream() does.
absl::Status QueryByCalls(grpc::GenericStub& stub, const BudgetTask& task, std::size_t& begin);

}  // namespace albtpu::client
