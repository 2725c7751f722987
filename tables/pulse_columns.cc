#include "tables/pulse_columns.h"

#include <algorithm>

namespace albtpu {
namespace {

float NumberAt(std::span<const float> column, std::size_t i) { return column[column.size() == 1 ? 0 : i]; }

}  // namespace

bool IsValid(const PulseColumns& pulses) {
  return std::all_of(kAxes.begin(), kAxes.end(), [&](AxisId axis) {
    const std::size_t length = pulses[axis].size();
    if (length == 0) return axis == AxisId::kFetch || axis == AxisId::kAzimuth;
    return length == 1 || length == pulses.size;
  });
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
