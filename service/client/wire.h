// Pulses and their uncertainty as columns of bytes, and back.
#pragma once

#include <span>

#include "absl/status/status.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::client {

// The pulses at `indices`, all of them with an azimuth or none. Coordinates that are alike for all travel
// once.
void ToWire(std::span<const Pulse> pulses, std::span<const std::size_t> indices,
            albtpu::v1::PulseColumns& columns);

// Puts answer i of the response into `answers[indices[i]]`. Internal when the response breaks its own rules:
// a column of another length, a number that is no outcome, another coverage than 2 sigma.
absl::Status FromWire(const albtpu::v1::QueryColumnsResponse& response, std::span<const std::size_t> indices,
                      bool standard_errors, std::span<PulseUncertainty> answers);

TableSummary FromWire(const albtpu::v1::Table& table);

}  // namespace albtpu::client
