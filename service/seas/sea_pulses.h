// Pulses on a sea whose waves are known.
#pragma once

#include "tables/query/pulse_columns.h"

namespace albtpu {

// The same pulses without wind speed and fetch, which have no effect on such a sea. As columns for a table of one sea.
inline PulseColumns OnOneSea(PulseColumns pulses) {
  for (const AxisId axis : {AxisId::kWindSpeed, AxisId::kFetch}) pulses.axis[Index(axis)] = {};
  return pulses;
}

}  // namespace albtpu
