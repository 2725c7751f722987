#include "tests/tables/query/asked_columns.h"

#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "tests/tables/synthetic_table.h"

namespace albtpu::testing {

PulseColumns Pulses(const Columns& columns, std::size_t size) {
  PulseColumns pulses{.size = size, .axis = {}};
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) pulses.axis[axis] = columns[axis];
  return pulses;
}

std::vector<float> RandomColumn(const std::vector<double>& nodes, bool turns, std::size_t size, std::mt19937& random) {
  const double beyond = (turns ? 4 : 0.01) * (nodes.back() - nodes.front());
  std::uniform_real_distribution<double> coordinate(nodes.front() - beyond, nodes.back() + beyond);
  std::vector<float> column;
  for (std::size_t i = 0; i < size; ++i) {
    double x = nodes.size() == 1 ? nodes[0] : coordinate(random);
    if (random() % 8 == 0) x = nodes[random() % nodes.size()];
    if (random() % 400 == 0) x = std::numeric_limits<float>::quiet_NaN();
    if (random() % 400 == 0) x = std::numeric_limits<float>::infinity();
    column.push_back(static_cast<float>(x));
  }
  return column;
}

Columns RandomColumns(const UncertaintyTable& table, std::size_t size, std::uint32_t seed) {
  std::mt19937 random(seed);
  Columns columns;
  for (const Axis& axis : table.axes()) {
    const bool turns = axis.schema().fold == Fold::kHalfTurn;
    columns[Index(axis.id())] = RandomColumn(axis.nodes(), turns, size, random);
  }
  return columns;
}

Columns LineColumns(std::size_t size) {
  Columns columns;
  columns[Index(AxisId::kWindSpeed)] = {5.5f};
  columns[Index(AxisId::kFetch)] = {2e4f};
  for (std::size_t i = 0; i < size; ++i) {
    const auto along = static_cast<float>(i);
    const float scan_angle = 20 * std::sin(along / 200);
    columns[Index(AxisId::kIncidence)].push_back(std::abs(scan_angle));
    columns[Index(AxisId::kAzimuth)].push_back(scan_angle > 0 ? 40.0f : 220.0f + 90 * (i / 1000 % 2));
    columns[Index(AxisId::kFootprint)].push_back(0.5f + 0.001f * std::abs(scan_angle));
    columns[Index(AxisId::kDepth)].push_back(8 + 5 * std::sin(along / 300));
  }
  return columns;
}

Answers::Answers(std::size_t size) : outcomes(size), axes(size), best(size), thu(size), tvu(size) {
  for (std::size_t q = 0; q < kQuantityCount; ++q) {
    values[q].resize(size);
    errors[q].resize(size);
  }
}

AnswerColumns Answers::columns() {
  AnswerColumns answers{.outcomes = outcomes.data(),
                        .outcome_axes = axes.data(),
                        .values = {},
                        .standard_errors = {},
                        .best_s44_orders = best.data(),
                        .remaining_thu = thu.data(),
                        .remaining_tvu = tvu.data()};
  for (std::size_t q = 0; q < kQuantityCount; ++q) {
    answers.values[q] = values[q].data();
    answers.standard_errors[q] = errors[q].data();
  }
  return answers;
}

std::vector<std::uint32_t> Answers::BitsAt(std::size_t i) const {
  std::vector<std::uint32_t> row = {outcomes[i], axes[i], best[i], std::bit_cast<std::uint32_t>(thu[i]),
                                    std::bit_cast<std::uint32_t>(tvu[i])};
  for (std::size_t q = 0; q < kQuantityCount; ++q) {
    row.push_back(std::bit_cast<std::uint32_t>(values[q][i]));
    row.push_back(std::bit_cast<std::uint32_t>(errors[q][i]));
  }
  return row;
}

Answers Ask(const ColumnInterpolator& interpolator, const Query& query, const PulseColumns& pulses) {
  Answers answers(pulses.size);
  interpolator.Interpolate(query, pulses, 0, pulses.size, answers.columns());
  return answers;
}

UncertaintyTable LogTable() {
  const UncertaintyTable linear = SyntheticTable();
  UncertaintyTable::Variables variables;
  for (Quantity quantity : kQuantities) {
    variables[Index(quantity)] = *linear.variable(quantity);
    if (Describe(quantity).is_bias) continue;
    variables[Index(quantity)]->scale = Scale::kLog;
  }
  return *UncertaintyTable::Create(linear.axes(), std::move(variables), linear.provenance());
}

std::vector<UncertaintyTable> TablesOfEachKind() {
  return {SyntheticTable(), SyntheticTable({.published = true}), LogTable(), TinyTable(), TinyTable(Scale::kLog),
          SyntheticSea()};
}

}  // namespace albtpu::testing
