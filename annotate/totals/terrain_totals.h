// What the slope of the terrain makes of the vertical total of a dry point (budget/total/terrain_error.h).
#pragma once

#include <cstddef>
#include <limits>

#include "annotate/totals/pulse_totals.h"
#include "budget/total/terrain_error.h"
#include "tables/coverage.h"

namespace albtpu::annotate {

struct SlopingPoint {
  TerrainGradient gradient;
  float footprint = 0;               // m, across the beam.
  float incidence = 0, azimuth = 0;  // degree, in air; where the beam travels to.
};

// Of a point without a slope there is none.
struct TerrainShare {
  float slope = std::numeric_limits<float>::quiet_NaN();  // degree
  float tvu_slope = -1, tvu_footprint = -1;  // m, at the coverage: of the horizontal error, of the footprint.
};

// Changes the vertical uncertainties of point i (of the total, the air side and the groups) to those of the height of
// the terrain at a fixed place. The spread of the footprint is drawn anew for each pulse. Requires `totals.whole`; the
// covariance stays that of the point itself.
TerrainShare AddTerrain(Coverage coverage, const SlopingPoint& point, std::size_t i, TotalBatch& totals);

}  // namespace albtpu::annotate
