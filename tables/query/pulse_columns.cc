#include "tables/query/pulse_columns.h"

#include <string>

#include "absl/strings/str_cat.h"

namespace albtpu {
namespace {

float NumberAt(std::span<const float> column, std::size_t i) { return column[column.size() == 1 ? 0 : i]; }

}  // namespace

absl::Status CheckLengths(const TableSchema& schema, const PulseColumns& pulses) {
  for (std::size_t axis = 0; axis < schema.axes.size(); ++axis) {
    const std::size_t length = pulses.axis[axis].size();
    const bool optional = schema.axes[axis].if_absent != IfAbsent::kRefuse;
    if (length == pulses.size || length == 1 || (length == 0 && optional)) continue;
    return absl::InvalidArgumentError(absl::StrCat("column '", std::string(schema.axes[axis].name), "' has ", length,
                                                   " numbers for ", pulses.size, " pulses: expected one for each pulse",
                                                   optional ? ", one for all or none" : " or one for all"));
  }
  return absl::OkStatus();
}

absl::Status CheckLengths(const PulseColumns& pulses) { return CheckLengths(kSeaSurface, pulses); }

PulseColumns Slice(const PulseColumns& pulses, std::size_t begin, std::size_t count) {
  PulseColumns slice = pulses;
  slice.size = count;
  for (std::span<const float>& column : slice.axis)
    if (column.size() > 1) column = column.subspan(begin, count);
  return slice;
}

Pulse PulseAt(const PulseColumns& pulses, std::size_t i) {
  Pulse pulse{.incidence = NumberAt(pulses[AxisId::kIncidence], i),
              .azimuth = {},
              .footprint = NumberAt(pulses[AxisId::kFootprint], i),
              .depth = NumberAt(pulses[AxisId::kDepth], i)};
  if (!pulses[AxisId::kWindSpeed].empty()) pulse.wind_speed = NumberAt(pulses[AxisId::kWindSpeed], i);
  if (!pulses[AxisId::kFetch].empty()) pulse.fetch = NumberAt(pulses[AxisId::kFetch], i);
  if (!pulses[AxisId::kAzimuth].empty()) pulse.azimuth = NumberAt(pulses[AxisId::kAzimuth], i);
  return pulse;
}

}  // namespace albtpu
