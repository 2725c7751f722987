// Columns of pulses to query tables with, and columns for all answers.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "tables/query/column_query.h"

namespace albtpu::testing {

inline constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

using Columns = std::array<std::vector<float>, kAxisCount>;

PulseColumns Pulses(const Columns& columns, std::size_t size);

// Uniform between the first and the last node and a little beyond, where half a turn folds it some turns beyond; one in
// eight on a node; a few NaN or infinite.
Columns RandomColumns(const UncertaintyTable& table, std::size_t size, std::uint32_t seed);

// A flight line, whose pulses often share a cell of the table.
Columns LineColumns(std::size_t size);

// Every node of a table of the sea, in the order of its values.
Columns NodeColumns(const UncertaintyTable& table);

// All answers to a query.
struct Answers {
  explicit Answers(std::size_t size);

  AnswerColumns columns();
  // The answers for one pulse.
  std::vector<std::uint32_t> BitsAt(std::size_t i) const;
  // The first pulse whose answers have other bits; none if all are the same.
  std::optional<std::size_t> FirstDifference(const Answers& other) const;

  std::vector<std::uint8_t> outcomes, axes, best;
  std::array<std::vector<float>, kQuantityCount> values, errors;
  std::vector<float> thu, tvu;
};

Answers Ask(const ColumnInterpolator& interpolator, const Query& query, const PulseColumns& pulses);

// The synthetic table with its uncertainties on a logarithmic scale.
UncertaintyTable LogTable();

// Tables of random axes and random values. Axes have one to six nodes, unevenly spaced, azimuth from 0 to 90 degrees.
// Uncertainties lie between 0.001 and 1, on a logarithmic scale in one table of three, biases between -1 and 1.
std::vector<UncertaintyTable> RoughTables(int count);

// Synthetic tables: with all variables, without standard errors and biases, on a logarithmic scale, tiny ones, and of
// one sea.
std::vector<UncertaintyTable> TablesOfEachKind();

}  // namespace albtpu::testing
