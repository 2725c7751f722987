#include "tables/query/pulse_columns.h"

#include <string>

#include "absl/strings/str_cat.h"

namespace albtpu {
namespace {

float NumberAt(std::span<const float> column, std::size_t i) { return column[column.size() == 1 ? 0 : i]; }

}  // namespace

absl::Status CheckLengths(const PulseColumns& pulses) {
  for (const AxisId axis : kAxes) {
    const std::size_t length = pulses[axis].size();
    const bool optional = axis == AxisId::kFetch || axis == AxisId::kAzimuth;
    if (length == pulses.size || length == 1 || (length == 0 && optional)) continue;
    return absl::InvalidArgumentError(absl::StrCat(
        "column '", std::string(Describe(axis).name), "' has ", length, " numbers for ", pulses.size,
        " pulses: one for each", optional ? ", one for all or none" : " or one for all", " would be right"));
  }
  return absl::OkStatus();
}

Pulse PulseAt(const PulseColumns& pulses, std::size_t i) {
  Pulse pulse{.wind_speed = NumberAt(pulses[AxisId::kWindSpeed], i),
              .incidence = NumberAt(pulses[AxisId::kIncidence], i),
              .azimuth = {},
              .footprint = NumberAt(pulses[AxisId::kFootprint], i),
              .depth = NumberAt(pulses[AxisId::kDepth], i)};
  if (!pulses[AxisId::kFetch].empty()) pulse.fetch = NumberAt(pulses[AxisId::kFetch], i);
  if (!pulses[AxisId::kAzimuth].empty()) pulse.azimuth = NumberAt(pulses[AxisId::kAzimuth], i);
  return pulse;
}

}  // namespace albtpu
