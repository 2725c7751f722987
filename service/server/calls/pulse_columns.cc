#include "service/server/calls/pulse_columns.h"

#include <algorithm>
#include <array>
#include <string>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "service/server/ground/limits.h"
#include "service/server/tables/field_violations.h"

namespace albtpu::server {
namespace {

using ColumnBytes = std::array<const std::string*, kAxisCount>;

bool MayBeAbsent(AxisId axis) { return axis == AxisId::kFetch || axis == AxisId::kAzimuth; }

std::string Quoted(AxisId axis) { return absl::StrCat("column '", std::string(Describe(axis).name), "'"); }

// The axis of the longest column.
AxisId Longest(const ColumnBytes& columns) {
  return *std::max_element(kAxes.begin(), kAxes.end(), [&](AxisId a, AxisId b) {
    return columns[Index(a)]->size() < columns[Index(b)]->size();
  });
}

std::string Path(AxisId axis) { return absl::StrCat("pulses.", std::string(Describe(axis).name)); }

absl::Status CheckBytes(const ColumnBytes& columns) {
  FieldViolations violations;
  for (AxisId axis : kAxes) {
    const std::size_t bytes = columns[Index(axis)]->size();
    if (bytes % sizeof(float) == 0) continue;
    violations.Add(Path(axis), absl::StrCat(Quoted(axis), " has ", bytes,
                                            " bytes: single precision numbers have 4 bytes each"));
  }
  return violations.ToStatus();
}

// What is wrong with the column of `axis`, of whole numbers, where the longest has `count`; empty: nothing.
std::string Problem(const ColumnBytes& columns, AxisId axis, AxisId longest, std::size_t count) {
  const std::size_t length = columns[Index(axis)]->size() / sizeof(float);
  if (length > kMaxPulses) {
    return absl::StrCat(Quoted(axis), " has ", length, " numbers: a message takes ", kMaxPulses,
                        " pulses, send several");
  }
  if (length == 0 && !MayBeAbsent(axis)) {
    return absl::StrCat(Quoted(axis), " is empty: send one number for each pulse, or one number for all");
  }
  if (length > 1 && length != count) {
    return absl::StrCat(Quoted(axis), " has ", length, " numbers, ", Quoted(longest), " has ", count,
                        ": send one number for each pulse, or one number for all");
  }
  return "";
}

absl::Status CheckLengths(const ColumnBytes& columns, AxisId longest) {
  const std::size_t count = columns[Index(longest)]->size() / sizeof(float);
  if (count == 0) return FieldViolation("pulses", "there is no pulse: send at least one");
  FieldViolations violations;
  for (AxisId axis : kAxes) {
    const std::string problem = Problem(columns, axis, longest, count);
    if (!problem.empty()) violations.Add(Path(axis), problem);
  }
  return violations.ToStatus();
}

}  // namespace

absl::StatusOr<PulseColumns> ReadColumns(const v1::PulseColumns& columns) {
  const ColumnBytes bytes = {&columns.wind_speed(), &columns.fetch(),     &columns.incidence(),
                             &columns.azimuth(),    &columns.footprint(), &columns.depth()};
  const AxisId longest = Longest(bytes);
  absl::Status status = CheckBytes(bytes);
  if (status.ok()) status = CheckLengths(bytes, longest);
  if (!status.ok()) return status;
  PulseColumns pulses;
  pulses.size = bytes[Index(longest)]->size() / sizeof(float);
  for (AxisId axis : kAxes) {
    const std::string& column = *bytes[Index(axis)];
    // A string's bytes are aligned for floats: within the string behind a pointer and a size, or on the heap.
    pulses.axis[Index(axis)] = {reinterpret_cast<const float*>(column.data()), column.size() / sizeof(float)};
  }
  return pulses;
}

}  // namespace albtpu::server
