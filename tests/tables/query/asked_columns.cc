#include "tests/tables/query/asked_columns.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "tests/tables/synthetic_table.h"

namespace albtpu::testing {
namespace {

std::vector<double> RandomNodes(AxisId axis, std::mt19937& random) {
  const std::size_t size = 1 + random() % 6;
  const bool from_zero = axis == AxisId::kIncidence || axis == AxisId::kAzimuth || axis == AxisId::kDepth;
  std::uniform_real_distribution<double> step(0.1, 3);
  std::vector<double> nodes = {from_zero ? 0.0 : step(random)};
  while (nodes.size() < size) nodes.push_back(nodes.back() + step(random));
  if (axis == AxisId::kAzimuth && size > 1) {
    for (double& node : nodes) node *= 90 / nodes.back();
    nodes.back() = 90;
  }
  return nodes;
}

}  // namespace

PulseColumns Pulses(const Columns& columns, std::size_t size) {
  PulseColumns pulses{.size = size, .axis = {}};
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) pulses.axis[axis] = columns[axis];
  return pulses;
}

Columns RandomColumns(const UncertaintyTable& table, std::size_t size, std::uint32_t seed) {
  std::mt19937 random(seed);
  Columns columns;
  for (const Axis& axis : table.axes()) {
    const std::vector<double>& nodes = axis.nodes();
    const double beyond = (axis.schema().fold == Fold::kHalfTurn ? 4 : 0.01) * (nodes.back() - nodes.front());
    std::uniform_real_distribution<double> coordinate(nodes.front() - beyond, nodes.back() + beyond);
    for (std::size_t i = 0; i < size; ++i) {
      double x = nodes.size() == 1 ? nodes[0] : coordinate(random);
      if (random() % 8 == 0) x = nodes[random() % nodes.size()];
      if (random() % 400 == 0) x = std::numeric_limits<float>::quiet_NaN();
      if (random() % 400 == 0) x = std::numeric_limits<float>::infinity();
      columns[Index(axis.id())].push_back(static_cast<float>(x));
    }
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

Columns NodeColumns(const UncertaintyTable& table) {
  Columns columns;
  for (std::size_t i = 0; i < ValueCount(table.axes(), Quantity::kThu); ++i) {
    std::size_t rest = i;
    for (std::size_t axis = kAxisCount; axis-- > 0;) {
      const std::vector<double>& nodes = table.axes()[axis].nodes();
      columns[axis].push_back(static_cast<float>(nodes[rest % nodes.size()]));
      rest /= nodes.size();
    }
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

std::optional<std::size_t> Answers::FirstDifference(const Answers& other) const {
  const std::size_t size = outcomes.size();
  std::size_t first = size;
  const auto compare = [&](const auto& ours, const auto& theirs) {
    for (std::size_t i = 0; i < first; ++i)
      if (std::memcmp(&ours[i], &theirs[i], sizeof ours[i]) != 0) first = i;
  };
  compare(outcomes, other.outcomes);
  compare(axes, other.axes);
  compare(best, other.best);
  compare(thu, other.thu);
  compare(tvu, other.tvu);
  for (std::size_t q = 0; q < kQuantityCount; ++q) {
    compare(values[q], other.values[q]);
    compare(errors[q], other.errors[q]);
  }
  return first < size ? std::optional(first) : std::nullopt;
}

Answers Ask(const ColumnInterpolator& interpolator, const Query& query, const PulseColumns& pulses) {
  Answers answers(pulses.size);
  interpolator.Interpolate(query, pulses, 0, pulses.size, answers.columns());
  return answers;
}

UncertaintyTable LogTable() {
  TableParts parts = PartsOf(SyntheticTable());
  for (const Quantity quantity : kQuantities)
    if (!Describe(quantity).is_bias) parts[quantity].scale = Scale::kLog;
  return *parts.Create();
}

std::vector<UncertaintyTable> RoughTables(int count) {
  std::vector<UncertaintyTable> tables;
  for (int seed = 1; seed <= count; ++seed) {
    std::mt19937 random(static_cast<std::uint32_t>(seed));
    TableParts parts = PartsOf(TinyTable());
    for (const AxisId axis : kAxes) parts.axes[Index(axis)] = MakeAxis(axis, RandomNodes(axis, random));
    std::uniform_real_distribution<float> logarithm(std::log(0.001f), 0.0f), bias(-1, 1);
    for (const Quantity quantity : kQuantities) {
      const bool is_bias = Describe(quantity).is_bias;
      parts[quantity].values.resize(ValueCount(parts.axes, quantity));
      parts[quantity].standard_errors.resize(parts[quantity].values.size());
      parts[quantity].scale = seed % 3 == 0 && !is_bias ? Scale::kLog : Scale::kLinear;
      for (float& value : parts[quantity].values) value = is_bias ? bias(random) : std::exp(logarithm(random));
      for (float& error : parts[quantity].standard_errors) error = std::exp(logarithm(random));
    }
    tables.push_back(*parts.Create());
  }
  return tables;
}

std::vector<UncertaintyTable> TablesOfEachKind() {
  return {SyntheticTable(), SyntheticTable({.published = true}), LogTable(), TinyTable(), TinyTable(Scale::kLog),
          SyntheticSea()};
}

}  // namespace albtpu::testing
