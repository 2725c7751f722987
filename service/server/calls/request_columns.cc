#include "service/server/calls/request_columns.h"

#include <algorithm>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "service/server/ground/errors.h"
#include "service/server/ground/limits.h"

namespace albtpu::server {
namespace {

std::string Quoted(const RequestColumn& column) {
  return absl::StrCat("column '", std::string(column.name), "'");
}

std::string Path(const RequestColumn& column) {
  return absl::StrCat(std::string(column.message), ".", std::string(column.name));
}

absl::Status CheckBytes(std::span<const RequestColumn> columns) {
  FieldViolations violations;
  for (const RequestColumn& column : columns) {
    const std::size_t bytes = column.bytes->size();
    if (bytes % sizeof(float) == 0) continue;
    violations.Add(Path(column), absl::StrCat(Quoted(column), " has ", bytes,
                                              " bytes: expected single precision numbers of 4 bytes each"));
  }
  return violations.ToStatus();
}

// The error in the column, or an empty string if it is valid. `longest` has one number for each pulse.
std::string ColumnError(const RequestColumn& column, const RequestColumn& longest) {
  const std::size_t length = column.numbers().size(), count = longest.numbers().size();
  if (length > kMaxPulses) {
    return absl::StrCat(Quoted(column), " has ", length, " numbers: a message takes ", kMaxPulses,
                        " pulses at most; send several messages");
  }
  if (length == 0 && column.required) {
    return absl::StrCat(Quoted(column), " is empty: send one number for each pulse, or one number for all");
  }
  if (length > 1 && length != count) {
    return absl::StrCat(Quoted(column), " has ", length, " numbers, ", Quoted(longest), " has ", count,
                        ": send one number for each pulse, or one number for all");
  }
  return "";
}

}  // namespace

absl::StatusOr<std::size_t> CountPulses(std::span<const RequestColumn> columns) {
  if (absl::Status status = CheckBytes(columns); !status.ok()) return status;
  const RequestColumn& longest = *std::max_element(
      columns.begin(), columns.end(),
      [](const RequestColumn& a, const RequestColumn& b) { return a.bytes->size() < b.bytes->size(); });
  if (longest.bytes->empty()) return FieldViolation("pulses", "there are no pulses: send at least one");
  FieldViolations violations;
  for (const RequestColumn& column : columns) {
    const std::string error = ColumnError(column, longest);
    if (!error.empty()) violations.Add(Path(column), error);
  }
  if (absl::Status status = violations.ToStatus(); !status.ok()) return status;
  return longest.numbers().size();
}

std::array<RequestColumn, kAxisCount> ColumnsOf(const v1::PulseColumns& columns, const TableSchema& schema) {
  const std::array<const std::string*, kAxisCount> bytes = {&columns.wind_speed(), &columns.fetch(),
                                                            &columns.incidence(),  &columns.azimuth(),
                                                            &columns.footprint(),  &columns.depth()};
  std::array<RequestColumn, kAxisCount> result;
  for (const AxisId axis : kAxes) {
    const std::size_t i = Index(axis);
    result[i] = {"pulses", Describe(axis).name, bytes[i], schema.axes[i].if_absent == IfAbsent::kRefuse};
  }
  return result;
}

PulseColumns PulsesOf(std::span<const RequestColumn> columns, std::size_t count) {
  PulseColumns pulses;
  pulses.size = count;
  for (std::size_t i = 0; i < columns.size(); ++i) pulses.axis[i] = columns[i].numbers();
  return pulses;
}

absl::StatusOr<PulseColumns> ReadPulseColumns(const v1::PulseColumns& columns, const TableSchema& schema) {
  const std::array<RequestColumn, kAxisCount> read = ColumnsOf(columns, schema);
  const absl::StatusOr<std::size_t> count = CountPulses(read);
  if (!count.ok()) return count.status();
  return PulsesOf(read, *count);
}

}  // namespace albtpu::server
