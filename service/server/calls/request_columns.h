// Checks the columns of a request and makes them accessible without copying.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "albtpu/v1/pulse.pb.h"
#include "tables/query/pulse_columns.h"

namespace albtpu::server {

// A column of single-precision numbers in a message of a request.
struct RequestColumn {
  std::string_view message;  // "pulses"
  std::string_view name;
  const std::string* bytes;
  bool required;

  // The bytes of a std::string are aligned for floats, both inside the object, after pointer and size, and on the heap.
  std::span<const float> numbers() const {
    return {reinterpret_cast<const float*>(bytes->data()), bytes->size() / sizeof(float)};
  }
};

// The number of pulses: the length of the longest column. Fails as documented for `QueryColumns`.
absl::StatusOr<std::size_t> CountPulses(std::span<const RequestColumn> columns);

// The columns of the axes of a table of this kind, in the order of kAxes. The result refers to `columns`.
std::array<RequestColumn, kAxisCount> ColumnsOf(const v1::PulseColumns& columns, const TableSchema& schema);

// The numbers of the columns of the axes.
PulseColumns PulsesOf(std::span<const RequestColumn> columns, std::size_t count);

// The columns of a table of this kind. The result refers to the memory of `columns`. Fails as documented for
// `QueryColumns`.
absl::StatusOr<PulseColumns> ReadPulseColumns(const v1::PulseColumns& columns, const TableSchema& schema);

}  // namespace albtpu::server
