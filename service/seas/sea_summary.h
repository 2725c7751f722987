// A summary of a sea as it was computed: its frame, its main numbers and the assumptions; and the pulses on it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tables/query/pulse_columns.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

struct SeaSummary {
  // Compass direction of the x axis, degrees, from which azimuths count: BeamAzimuth() of sea_attributes.h.
  double x_azimuth = 0;
  double significant_wave_height = 0;  // m, 4 sqrt(m0) of the whole sea
  double wind_speed_10m = 0;           // m/s, given or derived from the waves
  double water_depth = 0;              // m; infinity for deep water
  double tail_from = 0;                // Hz, where the wind's waves are joined; 0 without known waves
  double share_measured = 0;  // fraction of the slope variance at a footprint of 0.6 m that comes from known waves
  std::vector<std::string> assumptions;  // where the sea state has no value: one sentence each
};

// Of a table of one sea, from its attributes; nullopt for other tables.
std::optional<SeaSummary> SummaryOfSea(const UncertaintyTable& table);

// The same pulses without wind speed and fetch, which have no effect on such a sea. As columns for a table of one sea.
inline PulseColumns OnOneSea(PulseColumns pulses) {
  for (const AxisId axis : {AxisId::kWindSpeed, AxisId::kFetch}) pulses.axis[Index(axis)] = {};
  return pulses;
}

}  // namespace albtpu
