#include "service/server/calls/request_columns.h"

#include <algorithm>
#include <array>
#include <string>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "service/server/ground/errors.h"
#include "service/server/ground/limits.h"

namespace albtpu::server {
namespace {

using ColumnBytes = std::array<const std::string*, kAxisCount>;

std::string Quoted(AxisId axis) { return absl::StrCat("column '", std::string(Describe(axis).name), "'"); }

// The axis of the longest column, which has one number for each pulse.
AxisId LongestColumn(const ColumnBytes& columns) {
  return *std::max_element(kAxes.begin(), kAxes.end(), [&](AxisId a, AxisId b) {
    return columns[Index(a)]->size() < columns[Index(b)]->size();
  });
}

std::string Path(AxisId axis) { return absl::StrCat("pulses.", std::string(Describe(axis).name)); }

absl::Status CheckColumnBytes(const ColumnBytes& columns) {
  FieldViolations violations;
  for (AxisId axis : kAxes) {
    const std::size_t bytes = columns[Index(axis)]->size();
    if (bytes % sizeof(float) == 0) continue;
    violations.Add(Path(axis), absl::StrCat(Quoted(axis), " has ", bytes,
                                            " bytes: expected single precision numbers of 4 bytes each"));
  }
  return violations.ToStatus();
}

// The error in the column of `axis`, or an empty string if it is valid. `count` is the length of the longest column.
std::string ColumnError(const ColumnBytes& columns, const TableSchema& schema, AxisId axis, AxisId longest,
                        std::size_t count) {
  const std::size_t length = columns[Index(axis)]->size() / sizeof(float);
  if (length > kMaxPulses) {
    return absl::StrCat(Quoted(axis), " has ", length, " numbers: a message takes ", kMaxPulses,
                        " pulses at most; send several messages");
  }
  if (length == 0 && schema.axes[Index(axis)].if_absent == IfAbsent::kRefuse) {
    return absl::StrCat(Quoted(axis), " is empty: send one number for each pulse, or one number for all");
  }
  if (length > 1 && length != count) {
    return absl::StrCat(Quoted(axis), " has ", length, " numbers, ", Quoted(longest), " has ", count,
                        ": send one number for each pulse, or one number for all");
  }
  return "";
}

absl::Status CheckColumnLengths(const ColumnBytes& columns, const TableSchema& schema, AxisId longest) {
  const std::size_t count = columns[Index(longest)]->size() / sizeof(float);
  if (count == 0) return FieldViolation("pulses", "there are no pulses: send at least one");
  FieldViolations violations;
  for (AxisId axis : kAxes) {
    const std::string error = ColumnError(columns, schema, axis, longest, count);
    if (!error.empty()) violations.Add(Path(axis), error);
  }
  return violations.ToStatus();
}

}  // namespace

absl::StatusOr<PulseColumns> ReadPulseColumns(const v1::PulseColumns& columns, const TableSchema& schema) {
  const ColumnBytes bytes = {&columns.wind_speed(), &columns.fetch(),     &columns.incidence(),
                             &columns.azimuth(),    &columns.footprint(), &columns.depth()};
  const AxisId longest = LongestColumn(bytes);
  absl::Status status = CheckColumnBytes(bytes);
  if (status.ok()) status = CheckColumnLengths(bytes, schema, longest);
  if (!status.ok()) return status;
  PulseColumns pulses;
  pulses.size = bytes[Index(longest)]->size() / sizeof(float);
  for (AxisId axis : kAxes) {
    const std::string& column = *bytes[Index(axis)];
    // The bytes of a std::string are aligned for floats, both inside the object, after pointer and size, and on the
    // heap.
    pulses.axis[Index(axis)] = {reinterpret_cast<const float*>(column.data()), column.size() / sizeof(float)};
  }
  return pulses;
}

}  // namespace albtpu::server
