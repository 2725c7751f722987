// The provenance of a table: everything needed to judge it and to make it again, its interpolation error included.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "generator/campaign/campaign.h"
#include "generator/math/statistics.h"
#include "generator/monte_carlo/monte_carlo.h"
#include "tables/query/interpolation.h"
#include "tables/schema.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// The interpolation error of a table: random pulses, interpolated in the table and computed directly.

// The quantities that are checked. Biases are left out because they pass through zero, where relative errors have no
// meaning.
inline constexpr std::array<Quantity, 4> kChecked = {Quantity::kRefractionAlongWind, Quantity::kRefractionCrossWind,
                                                     Quantity::kThu, Quantity::kTvu};

// The pulse `index` of a campaign, drawn uniformly over its axes (in the logarithm on logarithmic axes).
Pulse CheckedPulse(const Campaign& campaign, std::size_t index);

// The uncertainty of the pulse, simulated for exactly its coordinates: the quantities of kChecked, in the units of the
// table. The random numbers are those of the table's nodes (kCellOfTables), so that chance has the same effect here and
// there, and the difference from the interpolated table is the interpolation error. Runs on all threads of the current
// TBB arena.
std::vector<Estimate> ComputeDirectly(const Campaign& campaign, const Pulse& pulse);

// The error of one quantity, relative to the direct values, over the pulses where 2 sigma is at least 0.01 degrees or 5
// mm and, in a table of winds, the wind at least 2 m/s. From there down to a calm, which has no waves at all, values
// fall by orders of magnitude, and the waves are not known well enough for the relative error of small values to
// matter.
struct InterpolationError {
  int pulses = 0;  // above these limits; all members are zero when there are none
  double rms = 0, percentile_99 = 0, greatest = 0;
  double noise = 0;  // rms standard error of the direct values; the errors of the table are correlated with it
};
// `direct` are the direct values at the pulses 0, 1, ... of the campaign; `checked` is an index of kChecked.
InterpolationError CompareWithTable(const Campaign& campaign, const UncertaintyTable& table,
                                    const std::vector<std::vector<Estimate>>& direct, std::size_t checked);

// The attributes of tables of every kind.
Provenance CommonProvenance(const Campaign& campaign);

// Of a table of the sea.
Provenance MakeProvenance(const Campaign& campaign, const std::vector<SeaCaseResult>& results);

// Adds the interpolation errors of the table, given for the quantities of kChecked.
void DescribeInterpolationErrors(const std::vector<InterpolationError>& errors, Provenance& provenance);

// The current time, or that of SOURCE_DATE_EPOCH where it is set, as 2026-01-31T12:00:00Z.
std::string DateCreated();

}  // namespace albtpu
