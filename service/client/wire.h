// Pulses and their uncertainty as columns of bytes, and back.
#pragma once

#include "absl/status/status.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::client {

// What the columns of the answers that are not null ask for.
void ToWire(const Query& query, const AnswerColumns& wanted, albtpu::v1::QueryColumnsRequest& request);

// A message tells the number of its pulses by its longest column: where all columns are one number for all,
// the depth is written for each.
void ToWire(const PulseColumns& pulses, albtpu::v1::PulseColumns& columns);

// Copies the columns that are wanted. Internal when the response breaks its own rules: another coverage than
// that of the query, a column of another length, a number that is no outcome or axis.
absl::Status FromWire(const albtpu::v1::QueryColumnsResponse& response, const Query& query,
                      std::size_t pulse_count, const AnswerColumns& answers);

TableSummary FromWire(const albtpu::v1::Table& table);

}  // namespace albtpu::client
