// How wrong a table is between its nodes: random pulses, asked of the table and computed at their
// place.
#pragma once

#include <array>
#include <vector>

#include "generator/campaign.h"
#include "generator/statistics.h"
#include "tables/interpolation.h"
#include "tables/schema.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// The quantities that are checked. Biases are left out: they pass through zero.
inline constexpr std::array<Quantity, 4> kChecked = {Quantity::kRefractionAlongWind, Quantity::kRefractionCrossWind,
                                                     Quantity::kThu, Quantity::kTvu};

// A pulse and its uncertainty as computed at its place, in the units of the table.
struct DirectAnswer {
  Pulse pulse;
  std::array<Estimate, kChecked.size()> values;  // as kChecked
};

// The pulse `index` of a campaign, drawn evenly over its axes (log axes in log), simulated by the random numbers with which
// all nodes of the table are (table_maker.h): what chance does to the one it does to the others, and what a table that
// is interpolated differs by is the error of interpolation. A function of its arguments alone; on all threads of the
// current TBB arena.
DirectAnswer AnswerDirectly(const Campaign& campaign, int index);

// Over many pulses, of one quantity, where it counts: 2 sigma of at least 0.01 degrees or 5 mm. Relative to the direct
// answers.
struct InterpolationError {
  int pulses = 0;  // that count; the others are zero when none does
  double rms = 0, percentile_99 = 0, greatest = 0;
  double noise = 0;  // rms standard error of the direct answers: the most that is left of chance
};
// `checked` is an index in kChecked.
InterpolationError CompareWithTable(const UncertaintyTable& table, const std::vector<DirectAnswer>& answers,
                                    std::size_t checked);

}  // namespace albtpu
