// Properties of every answer, whatever the table: checked on tables of random values and on a smooth one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tables/query/column_query.h"
#include "tests/instruction_sets.h"
#include "tests/tables/rough_table.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu {
namespace {

using ::albtpu::testing::Corners;
using ::albtpu::testing::CornersAround;
using ::albtpu::testing::RoughTable;
using ::albtpu::testing::SyntheticTable;

using Coordinates = std::array<float, kAxisCount>;
using Numbers = std::array<float, 2 * kQuantityCount>;  // the quantities, then their standard errors

constexpr float kRounding = 1e-6f;     // of the largest of the corners: record_blend.h
constexpr float kLogRounding = 1e-5f;  // relative, through logarithms in single precision
constexpr int kTables = 12;
constexpr int kPulses = 400;  // of each table

std::vector<UncertaintyTable> RoughTables() {
  std::vector<UncertaintyTable> tables;
  for (int seed = 1; seed <= kTables; ++seed)
    tables.push_back(RoughTable(static_cast<std::uint32_t>(seed), seed % 3 == 0 ? Scale::kLog : Scale::kLinear));
  return tables;
}

// A table, its interpolator, and random pulses in its domain.
class Asked {
 public:
  explicit Asked(const UncertaintyTable& table, std::uint32_t seed = 1)
      : table_(table), interpolator_(table), random_(seed) {}

  const UncertaintyTable& table() const { return table_; }
  std::mt19937& random() { return random_; }

  Coordinates AnyPulse() {
    Coordinates at;
    for (const Axis& axis : table_.axes()) at[Index(axis.id())] = Between(axis.nodes().front(), axis.nodes().back());
    return at;
  }
  float Between(double first, double last) {
    const double x = std::uniform_real_distribution<double>(first, last)(random_);
    return std::clamp(static_cast<float>(x), static_cast<float>(first), static_cast<float>(last));
  }

  // All numbers for each pulse. The pulses must be in the domain.
  std::vector<Numbers> Answer(const std::vector<Coordinates>& pulses) const {
    PulseColumns columns{.size = pulses.size(), .axis = {}};
    std::array<std::vector<float>, kAxisCount> axis_columns;
    for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
      for (const Coordinates& at : pulses) axis_columns[axis].push_back(at[axis]);
      columns.axis[axis] = axis_columns[axis];
    }
    std::vector<std::uint8_t> outcomes(pulses.size());
    std::array<std::vector<float>, 2 * kQuantityCount> numbers;
    for (std::vector<float>& column : numbers) column.resize(pulses.size());
    AnswerColumns answers;
    answers.outcomes = outcomes.data();
    for (std::size_t q = 0; q < kQuantityCount; ++q) {
      answers.values[q] = numbers[q].data();
      answers.standard_errors[q] = numbers[kQuantityCount + q].data();
    }
    interpolator_.Interpolate({}, columns, 0, pulses.size(), answers);
    std::vector<Numbers> rows(pulses.size());
    for (std::size_t i = 0; i < pulses.size(); ++i) {
      EXPECT_EQ(outcomes[i], 1) << i;
      for (std::size_t n = 0; n < numbers.size(); ++n) rows[i][n] = numbers[n][i];
    }
    return rows;
  }
  Numbers Answer(const Coordinates& at) const { return Answer(std::vector<Coordinates>{at})[0]; }

  // The rounding error that a number between these corners may have.
  float Tolerance(Quantity quantity, const std::vector<float>& corners) const {
    float largest = 0;
    for (const float corner : corners) largest = std::max(largest, std::abs(corner));
    const bool is_log = table_.variable(quantity)->scale == Scale::kLog;
    return largest * (is_log ? kLogRounding : kRounding);
  }

 private:
  const UncertaintyTable& table_;
  ColumnInterpolator interpolator_;
  std::mt19937 random_;
};

class EveryAnswer : public testing::OnInstructionSet {};
ALBTPU_ON_EACH_INSTRUCTION_SET(EveryAnswer);

TEST_P(EveryAnswer, IsBoundedByTheNodesAroundIt) {
  for (const UncertaintyTable& table : RoughTables()) {
    Asked asked(table);
    for (int i = 0; i < kPulses; ++i) {
      const Coordinates at = asked.AnyPulse();
      const Numbers answer = asked.Answer(at);
      for (const Quantity quantity : kQuantities) {
        const Corners corners = CornersAround(table, quantity, at);
        const auto expect_between = [&](float number, const std::vector<float>& nodes) {
          const auto [least, greatest] = std::minmax_element(nodes.begin(), nodes.end());
          const float tolerance = asked.Tolerance(quantity, nodes);
          ASSERT_GE(number, *least - tolerance) << Describe(quantity).name;
          ASSERT_LE(number, *greatest + tolerance) << Describe(quantity).name;
        };
        expect_between(answer[Index(quantity)], corners.values);
        expect_between(answer[kQuantityCount + Index(quantity)], corners.standard_errors);
      }
    }
  }
}

// From just before a node to just after it, a number changes by no more than the step times the slope in the two
// cells, which is at most the difference of their corners over the width of the narrower cell.
TEST_P(EveryAnswer, IsContinuousAcrossCells) {
  for (const UncertaintyTable& table : RoughTables()) {
    Asked asked(table);
    for (const Axis& axis : table.axes()) {
      for (std::size_t node = 1; node + 1 < axis.size(); ++node) {
        for (int i = 0; i < 20; ++i) {
          Coordinates at = asked.AnyPulse(), before = at, behind = at;
          const auto x = static_cast<float>(axis.nodes()[node]);
          at[Index(axis.id())] = x;
          before[Index(axis.id())] = std::nextafter(x, 0.0f);
          behind[Index(axis.id())] = std::nextafter(x, 2 * x);
          const double width =
              std::min(axis.nodes()[node] - axis.nodes()[node - 1], axis.nodes()[node + 1] - axis.nodes()[node]);
          const double log_factor = axis.scale() == Scale::kLog ? axis.nodes()[node + 1] / x : 1;
          const double step = (behind[Index(axis.id())] - before[Index(axis.id())]) / width * log_factor;
          const std::vector<Numbers> answers = asked.Answer({before, at, behind});
          for (const Quantity quantity : kQuantities) {
            std::vector<float> corners = CornersAround(table, quantity, before).values;
            for (const float corner : CornersAround(table, quantity, behind).values) corners.push_back(corner);
            const auto [least, greatest] = std::minmax_element(corners.begin(), corners.end());
            // On a log scale, the slope is at most the greatest corner times the log of the ratio of the corners.
            const bool is_log = table.variable(quantity)->scale == Scale::kLog;
            const double slope = is_log ? *greatest * std::log(*greatest / *least) : *greatest - *least;
            const double most = slope * step + 2 * asked.Tolerance(quantity, corners);
            ASSERT_NEAR(answers[0][Index(quantity)], answers[1][Index(quantity)], most);
            ASSERT_NEAR(answers[2][Index(quantity)], answers[1][Index(quantity)], most);
          }
        }
      }
    }
  }
}

// If all nodes around two depths grow with depth, so do the answers. THU and TVU of the smooth table grow everywhere.
void ExpectMonotone(const UncertaintyTable& table, bool everywhere) {
  Asked asked(table);
  const Axis& depths = table.axis(AxisId::kDepth);
  int grown = 0;
  for (int i = 0; i < kPulses; ++i) {
    Coordinates shallow = asked.AnyPulse(), deep = shallow;
    const std::size_t node = depths.Locate(shallow[Index(AxisId::kDepth)])->lower;
    const std::size_t next = std::min(node + 1, depths.size() - 1);
    float& d = shallow[Index(AxisId::kDepth)];
    d = asked.Between(depths.nodes()[node], depths.nodes()[next]);
    deep[Index(AxisId::kDepth)] = asked.Between(d, depths.nodes()[next]);
    const std::vector<Numbers> answers = asked.Answer({shallow, deep});
    for (const Quantity quantity : {Quantity::kThu, Quantity::kTvu}) {
      // Corners come in pairs along the depth, the last axis.
      const std::vector<float> corners = CornersAround(table, quantity, shallow).values;
      bool grows = true;
      for (std::size_t c = 0; c < corners.size(); c += 2) grows = grows && corners[c] <= corners[c + 1];
      if (everywhere) {
        ASSERT_TRUE(grows);
      }
      if (!grows) continue;
      ++grown;
      ASSERT_GE(answers[1][Index(quantity)], answers[0][Index(quantity)] - asked.Tolerance(quantity, corners));
    }
  }
  if (everywhere) {
    EXPECT_EQ(grown, 2 * kPulses);
  }
}

TEST_P(EveryAnswer, GrowsWithDepthWhereTheNodesDo) {
  ExpectMonotone(SyntheticTable(), true);
  for (const UncertaintyTable& table : RoughTables()) ExpectMonotone(table, false);
}

}  // namespace
}  // namespace albtpu
