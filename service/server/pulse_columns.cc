#include "service/server/pulse_columns.h"

#include <algorithm>
#include <array>
#include <string>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "service/server/limits.h"

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

absl::Status Check(const ColumnBytes& columns, AxisId longest) {
  const std::size_t count = columns[Index(longest)]->size() / sizeof(float);
  for (AxisId axis : kAxes) {
    const std::size_t bytes = columns[Index(axis)]->size();
    if (bytes % sizeof(float) != 0) {
      return absl::InvalidArgumentError(
          absl::StrCat(Quoted(axis), " has ", bytes, " bytes: single precision numbers have 4 bytes each"));
    }
  }
  if (count == 0) return absl::InvalidArgumentError("there is no pulse: send at least one");
  if (count > kMaxPulses) {
    return absl::InvalidArgumentError(absl::StrCat(
        Quoted(longest), " has ", count, " numbers: a message takes ", kMaxPulses, " pulses, send several"));
  }
  for (AxisId axis : kAxes) {
    const std::size_t length = columns[Index(axis)]->size() / sizeof(float);
    if (length == 0 && !MayBeAbsent(axis)) {
      return absl::InvalidArgumentError(
          absl::StrCat(Quoted(axis), " is empty: send one number for each pulse, or one number for all"));
    }
    if (length > 1 && length != count) {
      return absl::InvalidArgumentError(
          absl::StrCat(Quoted(axis), " has ", length, " numbers, ", Quoted(longest), " has ", count,
                       ": send one number for each pulse, or one number for all"));
    }
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<PulseColumns> ReadColumns(const v1::PulseColumns& columns) {
  const ColumnBytes bytes = {&columns.wind_speed(), &columns.fetch(),     &columns.incidence(),
                             &columns.azimuth(),    &columns.footprint(), &columns.depth()};
  const AxisId longest = Longest(bytes);
  const absl::Status status = Check(bytes, longest);
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
