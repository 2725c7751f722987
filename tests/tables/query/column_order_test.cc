// The answer for a pulse depends on this pulse alone, not on the number of pulses, their order or the number of
// cores.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <utility>
#include <vector>

#include "tables/query/column_query.h"
#include "tables/query/pulse_block.h"
#include "tables/query/sorted_pulses.h"
#include "tests/instruction_sets.h"
#include "tests/tables/query/asked_columns.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu {
namespace {

using ::albtpu::testing::Answers;
using ::albtpu::testing::Ask;
using ::albtpu::testing::Columns;
using ::albtpu::testing::LineColumns;
using ::albtpu::testing::MakeAxis;
using ::albtpu::testing::Pulses;
using ::albtpu::testing::RandomColumns;
using ::albtpu::testing::SyntheticTable;
using ::albtpu::testing::TablesOfEachKind;

// 81 920 nodes, so that pulses in random order are sorted.
UncertaintyTable LargeTable(Scale scale, bool errors) {
  std::vector<double> depths;
  for (int i = 0; i < 16; ++i) depths.push_back(2 * i);
  UncertaintyTable::Axes axes = {
      MakeAxis(AxisId::kWindSpeed, {1, 2, 3, 5, 7, 9, 12, 15}),    MakeAxis(AxisId::kFetch, {1e3, 1e4, 1e5, 1e6}),
      MakeAxis(AxisId::kIncidence, {0, 5, 9, 12, 15, 18, 21, 25}), MakeAxis(AxisId::kAzimuth, {0, 30, 60, 90}),
      MakeAxis(AxisId::kFootprint, {0.1, 0.3, 0.7, 1.5, 3}),       MakeAxis(AxisId::kDepth, depths)};
  std::mt19937 random(9);
  std::uniform_real_distribution<float> number(0.5f, 1.5f);
  UncertaintyTable::Variables variables;
  for (Quantity quantity : kQuantities) {
    std::vector<float> values(ValueCount(axes, quantity));
    for (float& value : values) value = number(random);
    const std::vector<float> standard_errors = errors ? values : std::vector<float>();
    const Scale of_quantity = Describe(quantity).is_bias ? Scale::kLinear : scale;
    variables[Index(quantity)] = Variable{values, standard_errors, of_quantity};
  }
  return *UncertaintyTable::Create(std::move(axes), std::move(variables), SyntheticTable().provenance());
}

class ColumnOrder : public testing::OnInstructionSet {};
ALBTPU_ON_EACH_INSTRUCTION_SET(ColumnOrder);

TEST_P(ColumnOrder, AnswersAPulseTheSameAloneAndAmongOthersBitByBit) {
  const Query query{.coverage = Coverage::kP95, .s44_order = S44Order::kSpecial};
  for (const UncertaintyTable& table : TablesOfEachKind()) {
    const ColumnInterpolator interpolator(table);
    for (Columns columns : {RandomColumns(table, 1500, 2), LineColumns(1500)}) {
      for (const bool azimuth_absent : {false, true}) {
        if (azimuth_absent) columns[Index(AxisId::kAzimuth)].clear();
        const PulseColumns pulses = Pulses(columns, 1500);
        const Answers together = Ask(interpolator, query, pulses);
        for (std::size_t i = 0; i < pulses.size; ++i) {
          PulseColumns alone{.size = 1, .axis = {}};
          for (AxisId axis : kAxes) {
            const std::span<const float> column = pulses[axis];
            alone.axis[Index(axis)] = column.size() <= 1 ? column : column.subspan(i, 1);
          }
          ASSERT_EQ(Ask(interpolator, query, alone).BitsAt(0), together.BitsAt(i)) << i;
        }
      }
    }
  }
}

TEST_P(ColumnOrder, AnswersTheSameInAnyOrderAndInPiecesBitByBit) {
  const UncertaintyTable table = SyntheticTable();
  const ColumnInterpolator interpolator(table);
  Columns columns = LineColumns(2000);
  const Answers forward = Ask(interpolator, {}, Pulses(columns, 2000));
  Answers pieces(2000);
  const std::vector<std::size_t> cuts = {0, 0, 1, 9, 300, 557, 1999, 2000};
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    interpolator.Interpolate({}, Pulses(columns, 2000), cuts[i], cuts[i + 1], pieces.columns());
  for (std::vector<float>& column : columns) {
    column.resize(2000, column.front());  // Also columns of one number.
    std::reverse(column.begin(), column.end());
  }
  const Answers backward = Ask(interpolator, {}, Pulses(columns, 2000));
  EXPECT_EQ(pieces.FirstDifference(forward), std::nullopt);
  for (std::size_t i = 0; i < 2000; ++i) ASSERT_EQ(backward.BitsAt(1999 - i), forward.BitsAt(i));
}

// More pulses than are sorted at a time.
constexpr std::size_t kPulseCount = 70'011, kFirst = 5, kPast = kPulseCount - 2;

// One block at a time, which is too few pulses to be sorted.
Answers AskInBlocks(const ColumnInterpolator& interpolator, const Query& query, const PulseColumns& pulses) {
  Answers answers(kPulseCount);
  for (std::size_t first = kFirst; first < kPast; first += kBlock)
    interpolator.Interpolate(query, pulses, first, std::min(first + kBlock, kPast), answers.columns());
  return answers;
}

TEST_P(ColumnOrder, AnswersManyPulsesInRandomOrderLikeFewBitByBit) {
  ASSERT_LT(SortedPulses::Fewest(81'920), SortedPulses::kMost);
  const Query query{.coverage = Coverage::kP95, .s44_order = S44Order::kSpecial};
  Columns columns = RandomColumns(LargeTable(Scale::kLinear, false), kPulseCount, 8);
  columns[Index(AxisId::kAzimuth)][300] = 4e9f;
  Columns constants = columns;
  constants[Index(AxisId::kWindSpeed)].resize(1);
  constants[Index(AxisId::kAzimuth)].clear();
  for (const Columns& asked : {columns, constants}) {
    const PulseColumns pulses = Pulses(asked, kPulseCount);
    for (const bool errors : {true, false}) {
      for (const Scale scale : {Scale::kLinear, Scale::kLog}) {
        const ColumnInterpolator interpolator(LargeTable(scale, errors));
        const Answers few = AskInBlocks(interpolator, query, pulses);
        Answers many(kPulseCount);
        interpolator.Interpolate(query, pulses, kFirst, kPast, many.columns());
        EXPECT_EQ(many.FirstDifference(few), std::nullopt);

        std::vector<float> thu(kPulseCount);
        AnswerColumns one_column;
        one_column.values[Index(Quantity::kThu)] = thu.data();
        interpolator.Interpolate(query, pulses, kFirst, kPast, one_column);
        EXPECT_EQ(std::memcmp(thu.data(), few.values[Index(Quantity::kThu)].data(), kPulseCount * sizeof(float)), 0);
      }
    }
  }
}

// Enough pulses for several pieces, each of which is large enough to be sorted in random order.
TEST_P(ColumnOrder, AnswersTheSameOnAllCoresAsOnOneBitByBit) {
  const UncertaintyTable table = LargeTable(Scale::kLinear, true);
  const ColumnInterpolator interpolator(table);
  for (const Columns& columns : {LineColumns(kPulseCount), RandomColumns(table, kPulseCount, 4)}) {
    const Answers one = Ask(interpolator, {}, Pulses(columns, kPulseCount));
    Answers all(kPulseCount);
    InterpolateOnAllCores(interpolator, {}, Pulses(columns, kPulseCount), all.columns());
    EXPECT_EQ(all.FirstDifference(one), std::nullopt);
  }
}

}  // namespace
}  // namespace albtpu
