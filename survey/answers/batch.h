// Memory for a batch of pulses and for their answers, reused from batch to batch.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tables/query/pulse_columns.h"

namespace albtpu::client {

// Of each axis a number for each pulse, one for all, or none (PulseColumns).
struct PulseBatch {
  std::size_t size = 0;
  std::array<std::vector<float>, kAxisCount> axis;

  std::vector<float>& operator[](AxisId id) { return axis[Index(id)]; }
  PulseColumns columns() const;
};

// Which answers are wanted beside the outcomes.
struct AnswerSelection {
  std::array<bool, kQuantityCount> quantities = {};
  bool standard_errors = false;  // Of those quantities.
  bool best_s44_orders = false;
  bool s44_remaining = false;
};

// Answer i is element i of each column; those that are not selected are empty.
struct AnswerBatch {
  std::vector<std::uint8_t> outcomes, outcome_axes;
  std::array<std::vector<float>, kQuantityCount> values, standard_errors;
  std::vector<std::uint8_t> best_s44_orders;
  std::vector<float> remaining_thu, remaining_tvu;

  // Makes room for `count` answers; what was there before is lost.
  AnswerColumns Resize(std::size_t count, const AnswerSelection& selection);

  bool interpolated(std::size_t i) const { return outcomes[i] == 1; }
  std::span<const float> operator[](Quantity quantity) const { return values[Index(quantity)]; }
};

}  // namespace albtpu::client
