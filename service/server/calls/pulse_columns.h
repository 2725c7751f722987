// The pulses of `QueryColumns`, read where they lie.
#pragma once

#include "absl/status/statusor.h"
#include "albtpu/v1/pulse.pb.h"
#include "tables/query/pulse_columns.h"

namespace albtpu::server {

// Refers to the message that it was read from. Fails as `QueryColumns` documents.
absl::StatusOr<PulseColumns> ReadColumns(const v1::PulseColumns& columns);

}  // namespace albtpu::server
