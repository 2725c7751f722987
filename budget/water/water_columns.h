// The share of a water in the totals of many pulses, in the columns that a budget takes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "budget/water/known_water.h"

namespace albtpu {

// A column of one number holds for all pulses. Degrees in air, m, m.
struct WaterPulses {
  std::size_t size = 0;
  std::span<const float> incidence, depth;
  std::span<const float> footprint;  // Empty: not known.
};

// Columns of BudgetInputs, one element for each pulse; m, at 1 sigma. The first four are empty without a share, the
// biases where nothing biases the points.
struct WaterBatch {
  // sigma_vertical is NaN at a pulse that the share does not know.
  std::vector<float> sigma_along, sigma_vertical, correlation, noise;
  // What the water left in the points; of a pulse that the share does not know, that of the index alone.
  std::vector<float> bias_along, bias_vertical;
  std::vector<float> stretch;  // of the echo

  // Whether the share does not know pulse i.
  bool is_beyond(std::size_t i) const;
};

// `index` is that of the budget, which refracts.
void ComputeWater(const CompiledWater& water, double index, const WaterPulses& pulses, WaterBatch& batch);

}  // namespace albtpu
