// Pulses and their uncertainty as columns of bytes, and back.
#pragma once

#include "absl/status/status.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::client {

// What the columns of the answers that are not null ask for.
void ToWire(const Query& query, const AnswerColumns& wanted, albtpu::v1::QueryColumnsRequest& request);

void ToWire(const PulseColumns& pulses, albtpu::v1::PulseColumns& columns);

// Copies the columns that are wanted. Internal when the response breaks its own rules: a column of another
// length.
absl::Status FromWire(const albtpu::v1::QueryColumnsResponse& response, std::size_t pulse_count,
                      const AnswerColumns& answers);

TableSummary FromWire(const albtpu::v1::Table& table);

}  // namespace albtpu::client
