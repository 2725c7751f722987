// Tables of other kinds than the sea surface: the fast path agrees with its slow twin, both by the schema alone.
#include "tables/query/table_interpolation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/instruction_sets.h"
#include "tests/tables/query/asked_columns.h"
#include "tests/tables/query/table_kinds.h"

namespace albtpu {
namespace {

using ::albtpu::testing::kHalfTurn;
using ::albtpu::testing::kLargestKind;
using ::albtpu::testing::kOneAxis;
using ::albtpu::testing::kThreeAxes;
using ::albtpu::testing::RandomTable;

// The error of single precision: relative, and where corners cancel, relative to the largest value, which is 1.
constexpr double kTolerance = 1e-5, kCancelled = 4e-7;

using Columns = std::array<std::vector<float>, kMaxAxes>;

PulseColumns Pulses(const Columns& columns, std::size_t size) {
  PulseColumns pulses{.size = size, .axis = {}};
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) pulses.axis[axis] = columns[axis];
  return pulses;
}

Columns RandomColumns(const Table& table, std::size_t size, std::uint32_t seed) {
  std::mt19937 random(seed);
  Columns columns;
  for (std::size_t axis = 0; axis < table.axes().size(); ++axis) {
    const bool turns = table.schema().axes[axis].fold == Fold::kHalfTurn;
    columns[axis] = albtpu::testing::RandomColumn(table.axes()[axis].nodes(), turns, size, random);
  }
  return columns;
}

struct Answers {
  Answers(const Table& table, std::size_t size) : outcomes(size), axes(size) {
    for (std::size_t q = 0; q < table.schema().quantities.size(); ++q) {
      values[q].resize(size);
      errors[q].resize(size);
    }
  }
  ValueColumns columns() {
    ValueColumns all{
        .outcomes = outcomes.data(), .outcome_axes = axes.data(), .values = {}, .standard_errors = {}};
    for (std::size_t q = 0; q < kMaxQuantities; ++q) {
      if (values[q].empty()) continue;
      all.values[q] = values[q].data();
      all.standard_errors[q] = errors[q].data();
    }
    return all;
  }

  std::vector<std::uint8_t> outcomes, axes;
  std::array<std::vector<float>, kMaxQuantities> values, errors;
};

Answers Interpolated(const Table& table, const PulseColumns& pulses) {
  Answers answers(table, pulses.size);
  TableInterpolator(table).Interpolate(pulses, 0, pulses.size, answers.columns());
  return answers;
}

void ExpectNear(float fast, float slow) {
  ASSERT_EQ(std::isnan(fast), std::isnan(slow));
  if (std::isnan(slow)) return;
  ASSERT_NEAR(fast, slow, kTolerance * std::abs(slow) + kCancelled);
}

void ExpectSlowTwin(const Table& table, const PulseColumns& pulses) {
  ASSERT_TRUE(CheckLengths(table.schema(), pulses).ok());
  const Answers answers = Interpolated(table, pulses);
  int inside = 0;
  for (std::size_t i = 0; i < pulses.size; ++i) {
    SCOPED_TRACE(i);
    std::vector<std::optional<float>> coordinates;
    for (std::size_t axis = 0; axis < table.axes().size(); ++axis) {
      const std::span<const float> column = pulses.axis[axis];
      coordinates.push_back(column.empty() ? std::optional<float>()
                                           : std::optional<float>(column[column.size() == 1 ? 0 : i]));
    }
    const TableValues slow = Interpolate(table, coordinates);
    ASSERT_EQ(answers.outcomes[i], static_cast<int>(slow.outcome) + 1);
    ASSERT_EQ(answers.axes[i], slow.axis.has_value() ? *slow.axis + 1 : 0);
    inside += slow.outcome == Outcome::kInterpolated ? 1 : 0;
    for (std::size_t q = 0; q < table.schema().quantities.size(); ++q) {
      ExpectNear(answers.values[q][i], slow.values[q]);
      ExpectNear(answers.errors[q][i], slow.standard_errors[q]);
    }
  }
  EXPECT_GT(inside, static_cast<int>(pulses.size) / 4);
}

std::vector<Table> TablesOfOtherKinds() {
  return {RandomTable(kThreeAxes, {4, 3, 5}, 1),
          RandomTable(kThreeAxes, {4, 3, 5}, 2, Scale::kLog),
          RandomTable(kThreeAxes, {4, 3, 5}, 3, Scale::kLinear, false),
          RandomTable(kThreeAxes, {1, 1, 1}, 4),
          RandomTable(kThreeAxes, {60, 40, 30}, 5),  // Large enough for pulses in random order to be sorted.
          RandomTable(kLargestKind, {3, 2, 4, 2, 3, 3}, 6),
          RandomTable(kLargestKind, {2, 1, 3, 1, 2, 1}, 7, Scale::kLog),
          RandomTable(kOneAxis, {7}, 8),
          RandomTable(kHalfTurn, {3, 5, 4}, 9),
          RandomTable(kHalfTurn, {1, 7, 4}, 10, Scale::kLog),
          RandomTable(kHalfTurn, {40, 60, 30}, 11)};
}

class TableInterpolation : public testing::OnInstructionSet {};
ALBTPU_ON_EACH_INSTRUCTION_SET(TableInterpolation);

TEST_P(TableInterpolation, AgreesWithTheSlowTwin) {
  for (const Table& table : TablesOfOtherKinds()) {
    SCOPED_TRACE(table.schema().name);
    ExpectSlowTwin(table, Pulses(RandomColumns(table, 3001, 1), 3001));
  }
}

TEST_P(TableInterpolation, TakesAbsentColumnsAsTheSchemaSays) {
  for (const Table& table : TablesOfOtherKinds()) {
    SCOPED_TRACE(table.schema().name);
    if (table.axes().size() > 1 && table.axes().front().size() == 1)
      continue;  // Its only heading is not at an end.
    Columns columns = RandomColumns(table, 3001, 2);
    for (std::size_t axis = 0; axis < table.axes().size(); ++axis) {
      if (table.schema().axes[axis].if_absent == IfAbsent::kRefuse) continue;
      columns[axis].clear();
      ExpectSlowTwin(table, Pulses(columns, 3001));
    }
  }
}

TEST_P(TableInterpolation, TakesOneNumberForAllPulses) {
  for (const Table& table : TablesOfOtherKinds()) {
    for (std::size_t constant = 0; constant < table.axes().size(); ++constant) {
      Columns columns = RandomColumns(table, 500, 3);
      columns[constant] = {static_cast<float>(table.axes()[constant].nodes().back())};
      ExpectSlowTwin(table, Pulses(columns, 500));
    }
  }
}

TEST(TableColumns, MayLackOnlyWhatTheSchemaAllows) {
  const std::vector<float> three = {1, 2, 3};
  for (std::size_t absent = 0; absent < kThreeAxes.axes.size(); ++absent) {
    PulseColumns pulses{.size = 3, .axis = {three, three, three}};
    pulses.axis[absent] = {};
    EXPECT_EQ(CheckLengths(kThreeAxes, pulses).ok(), absent != 2);
  }
}

}  // namespace
}  // namespace albtpu
