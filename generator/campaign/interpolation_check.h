// How wrong a table is between its nodes: random pulses, asked of the table and computed at their
// place.
#pragma once

#include <array>
#include <vector>

#include "generator/campaign/campaign.h"
#include "generator/math/statistics.h"
#include "tables/query/interpolation.h"
#include "tables/schema.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// The quantities that are checked. Biases are left out: they pass through zero.
inline constexpr std::array<Quantity, 4> kChecked = {
    Quantity::kRefractionAlongWind, Quantity::kRefractionCrossWind, Quantity::kThu, Quantity::kTvu};

// The pulse `index` of a campaign, drawn evenly over its axes (log axes in log).
Pulse CheckedPulse(const Campaign& campaign, std::size_t index);

// Its uncertainty as computed at its place, by the random numbers with which all nodes of the table are
// (table_maker.h): what chance does to the one it does to the others, and what a table that is interpolated
// differs by is the error of interpolation. As kChecked, in the units of the table. On all threads of the
// current TBB arena.
std::vector<Estimate> AnswerDirectly(const Campaign& campaign, const Pulse& pulse);

// Over many pulses, of one quantity, where it counts: 2 sigma of at least 0.01 degrees or 5 mm. Relative to
// the direct answers.
struct InterpolationError {
  int pulses = 0;  // that count; the others are zero when none does
  double rms = 0, percentile_99 = 0, greatest = 0;
  double noise = 0;  // rms standard error of the direct answers; the table's own goes with it
};
// `answers` are those to the pulses 0, 1, ... of the campaign; `checked` is an index in kChecked.
InterpolationError CompareWithTable(const Campaign& campaign, const UncertaintyTable& table,
                                    const std::vector<std::vector<Estimate>>& answers, std::size_t checked);

}  // namespace albtpu
