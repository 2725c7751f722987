// Queries of the whole budget as messages, and their answers.
#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <cstddef>

#include "absl/status/statusor.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "budget/query/budget_query.h"
#include "service/column_message.h"

namespace albtpu::client {

// Sets the options and the quantities of a request: those that fill the columns of `wanted` that are not null.
void ToWire(const BudgetOptions& options, const BudgetPulses& pulses, const BudgetAnswers& wanted,
            albtpu::v1::QueryBudgetRequest& request);

// Adds the fields `pulses` and `aircraft` of a QueryBudgetRequest.
void AddPulses(const BudgetPulses& pulses, ColumnMessage& request);

// The number of pulses that a message of these columns takes, request and answer.
std::size_t MostPulses(const BudgetPulses& pulses, const BudgetAnswers& wanted);

// Reads a QueryBudgetResponse about `count` pulses. Fills the columns of `answers` from `begin` on, and returns the
// digest of the table. Internal when the answer violates the protocol: its coverage is not that of `options`, a column
// has the wrong length, or a number is not a known outcome, axis or order.
absl::StatusOr<std::string> ReadBudget(grpc::ByteBuffer& bytes, const BudgetOptions& options, std::size_t begin,
                                       std::size_t count, const BudgetAnswers& answers);

}  // namespace albtpu::client
