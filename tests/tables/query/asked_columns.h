// Columns of pulses to ask tables for, and all that can be answered.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tables/query/column_query.h"

namespace albtpu::testing {

using Columns = std::array<std::vector<float>, kAxisCount>;

PulseColumns Pulses(const Columns& columns, std::size_t size);

// Uniform between a little outside the axes; an eighth on nodes; few are not numbers.
Columns RandomColumns(const UncertaintyTable& table, std::size_t size, std::uint32_t seed);

// A flight line, which stays in cells of the table.
Columns LineColumns(std::size_t size);

// All that can be answered, of one query.
struct Answers {
  explicit Answers(std::size_t size);

  AnswerColumns columns();
  // All of one pulse.
  std::vector<std::uint32_t> BitsAt(std::size_t i) const;

  std::vector<std::uint8_t> outcomes, axes, best;
  std::array<std::vector<float>, kQuantityCount> values, errors;
  std::vector<float> thu, tvu;
};

Answers Ask(const ColumnInterpolator& interpolator, const Query& query, const PulseColumns& pulses);

// The synthetic table, its uncertainties on a logarithmic scale.
UncertaintyTable LogTable();

// Synthetic ones: with all variables, without errors and biases, with logarithms, and tiny ones.
std::vector<UncertaintyTable> TablesOfEachKind();

}  // namespace albtpu::testing
