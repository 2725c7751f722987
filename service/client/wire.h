// Pulses and their uncertainty as columns of bytes, and back.
#pragma once

#include <span>

#include "absl/status/status.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::client {

// The pulses, all of them with an azimuth. Coordinates that are alike for all travel once.
void ToWire(std::span<const Pulse> pulses, albtpu::v1::PulseColumns& columns);

// Puts answer i of the response into `answers[i]`. Internal when the response breaks its own rules: a column
// of another length, a number that is no outcome, another coverage than 2 sigma.
absl::Status FromWire(const albtpu::v1::QueryColumnsResponse& response, bool standard_errors,
                      std::span<PulseUncertainty> answers);

TableSummary FromWire(const albtpu::v1::Table& table);

}  // namespace albtpu::client
