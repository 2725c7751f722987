// Calls of `QueryBudget`, seen from the client.
#pragma once

#include <grpcpp/generic/generic_stub.h>

#include <cstddef>
#include <string>

#include "absl/status/status.h"
#include "albtpu/v1/sea.pb.h"
#include "budget/query/budget_query.h"

namespace albtpu::client {

// A query about any number of pulses, and the memory for its answers.
struct BudgetTask {
  const std::string& table;         // Its name; empty for a sea.
  const std::string& digest;        // The digest that every answer must come from.
  const albtpu::v1::SeaState* sea;  // Null for a table of the server's.
  const BudgetOptions& options;
  const BudgetPulses& pulses;
  const BudgetAnswers& answers;
};

// Queries the pulses from index `begin` on, a few calls at a time, until all are answered or something fails. Sets
// `begin` and fails as QueryByStream() does.
absl::Status QueryByCalls(grpc::GenericStub& stub, const BudgetTask& task, std::size_t& begin);

}  // namespace albtpu::client
