// Columns of pulses whose whole budget is asked, and of the answers.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "budget/query/budget_query.h"
#include "tests/budget/total/total_memory.h"

namespace albtpu::testing {

struct BudgetPulseMemory {
  std::array<std::vector<float>, kAxisCount> axes;
  std::array<std::vector<float>, kBudgetInputCount> inputs;
  std::size_t size = 0;

  std::vector<float>& operator[](BudgetInput input) { return inputs[static_cast<std::size_t>(input)]; }

  BudgetPulses columns() const {
    BudgetPulses pulses;
    pulses.pulses.size = pulses.aircraft.size = size;
    for (std::size_t i = 0; i < kAxisCount; ++i) pulses.pulses.axis[i] = axes[i];
    for (std::size_t i = 0; i < kBudgetInputCount; ++i) pulses.aircraft.columns[i] = inputs[i];
    pulses.sea_axis = 250;
    return pulses;
  }
};

// Within the synthetic tables.
inline BudgetPulseMemory RandomBudgetPulses(std::size_t count, unsigned seed = 1) {
  std::mt19937 random(seed);
  BudgetPulseMemory pulses;
  pulses.size = count;
  const auto draw = [&](std::vector<float>& column, float least, float most) {
    for (std::size_t i = 0; i < count; ++i)
      column.push_back(least + (most - least) * static_cast<float>(random() >> 8) / static_cast<float>(1 << 24));
  };
  constexpr std::array<std::array<float, 2>, kAxisCount> kAxisRanges = {
      {{3, 10}, {1000, 100000}, {0, 25}, {-180, 180}, {0.25f, 2}, {0, 20}}};
  for (std::size_t i = 0; i < kAxisCount; ++i) draw(pulses.axes[i], kAxisRanges[i][0], kAxisRanges[i][1]);
  Draw(kAircraftRanges, count, random, pulses);
  using enum BudgetInput;
  for (const BudgetInput sigma : {kPositionSigmaNorth, kPositionSigmaEast, kPositionSigmaDown, kRollSigma, kPitchSigma,
                                  kHeadingSigma, kWaveHeight})
    draw(pulses[sigma], 0.001f, 0.1f);
  return pulses;
}

inline BudgetOptions UsualOptions() {
  return {.errors = {.position = {0.03, 0.03, 0.05},
                     .attitude = {0.0025, 0.0025, 0.005},
                     .boresight = {0.001, 0.001, 0.004},
                     .lever_arm = 0.02,
                     .scan = 0.001,
                     .time = 1e-5,
                     .range_offset = 0.01,
                     .bottom_range = 0.025,
                     .surface_height = 0.05,
                     .index = 0.001},
          .located = SurfaceLocation::kLocal,
          .lever_arm = {0.3, -0.2, 0.5},
          .datum = 0.08,
          .extra_horizontal = 0.04,
          .extra_vertical = 0.03,
          .coverage = Coverage::kP95};
}

struct BudgetMemory {
  explicit BudgetMemory(std::size_t size) : outcomes(size, 255), outcome_axes(size, 255), best_s44_orders(size, 255) {
    numbers.fill(std::vector<float>(size, -1));
  }

  BudgetAnswers columns() {
    BudgetAnswers answers{.outcomes = outcomes.data(), .outcome_axes = outcome_axes.data()};
    for (std::size_t i = 0; i < kBudgetColumnCount; ++i) answers.columns[i] = numbers[i].data();
    answers.best_s44_orders = best_s44_orders.data();
    return answers;
  }
  float at(BudgetQuantity quantity, std::size_t i) const { return numbers[FirstColumn(quantity)][i]; }

  std::vector<std::uint8_t> outcomes, outcome_axes, best_s44_orders;
  std::array<std::vector<float>, kBudgetColumnCount> numbers;
};

}  // namespace albtpu::testing
