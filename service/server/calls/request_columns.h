// Checks the pulse columns of a request and makes them accessible without copying.
#pragma once

#include "absl/status/statusor.h"
#include "albtpu/v1/pulse.pb.h"
#include "tables/query/pulse_columns.h"

namespace albtpu::server {

// The columns of a table of this kind. The result refers to the memory of `columns`. Fails as documented for
// `QueryColumns`.
absl::StatusOr<PulseColumns> ReadPulseColumns(const v1::PulseColumns& columns, const TableSchema& schema);

}  // namespace albtpu::server
