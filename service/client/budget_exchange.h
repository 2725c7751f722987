// Calls of `QueryBudget`, seen from the client.
#pragma once

#include <grpcpp/generic/generic_stub.h>

#include <cstddef>

#include "absl/status/status.h"
#include "budget/query/budget_query.h"
#include "service/client/column_exchange.h"

namespace albtpu::client {

using BudgetTask = Task<BudgetOptions, BudgetPulses, BudgetAnswers>;

// Queries the pulses from index `begin` on, a few calls at a time, until all are answered or something fails. Sets
// `begin` and fails as QueryByStream() does.
absl::Status QueryByCalls(grpc::GenericStub& stub, const BudgetTask& task, std::size_t& begin);

}  // namespace albtpu::client
