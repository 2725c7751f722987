#include "tables/query/column_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "tests/instruction_sets.h"
#include "tests/tables/query/asked_columns.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu {
namespace {

using ::albtpu::testing::Answers;
using ::albtpu::testing::Ask;
using ::albtpu::testing::Columns;
using ::albtpu::testing::LineColumns;
using ::albtpu::testing::LogTable;
using ::albtpu::testing::NodeColumns;
using ::albtpu::testing::Pulses;
using ::albtpu::testing::RandomColumns;
using ::albtpu::testing::RoughTables;
using ::albtpu::testing::SyntheticSea;
using ::albtpu::testing::SyntheticTable;
using ::albtpu::testing::TablesOfEachKind;
using ::albtpu::testing::TinyTable;

using ::albtpu::testing::kInfinity;
using ::albtpu::testing::kNaN;
constexpr double kTolerance = 1e-5;  // relative
constexpr double kCancelled = 4e-7;  // of the largest value of a quantity

double Largest(const std::vector<float>& numbers) {
  double largest = 0;
  for (float number : numbers) largest = std::max(largest, std::abs(static_cast<double>(number)));
  return largest;
}

// If corners of both signs cancel, or a corner of 0 has nearly all of the weight, the error is relative to the
// largest value.
void ExpectNear(float ours, double exact, double largest, const std::string& what) {
  if (std::isnan(exact)) {
    ASSERT_TRUE(std::isnan(ours)) << what << " is " << ours;
  } else
    ASSERT_NEAR(ours, exact, kTolerance * std::abs(exact) + kCancelled * largest) << what;
}

// If little remains of a limit, it is the difference of larger numbers.
void ExpectRemaining(float ours, std::optional<double> exact, double limit) {
  ASSERT_EQ(std::isnan(ours), !exact.has_value());
  if (!exact.has_value()) return;
  ASSERT_NEAR(ours * ours, *exact * *exact, kTolerance * limit * limit);
}

// Expects the answers of the slow twin, pulse by pulse.
void ExpectTwin(const UncertaintyTable& table, const Query& query, const PulseColumns& pulses, const Answers& answers) {
  std::array<double, kQuantityCount> largest{};
  for (Quantity quantity : kQuantities) {
    const Variable* variable = table.variable(quantity);
    if (variable != nullptr) largest[Index(quantity)] = Largest(variable->values);
  }
  for (std::size_t i = 0; i < pulses.size; ++i) {
    SCOPED_TRACE(i);
    const Pulse pulse = PulseAt(pulses, i);
    const PulseUncertainty two_sigma = Interpolate(table, pulse);
    const PulseUncertainty twin = WithCoverage(two_sigma, query.coverage);
    ASSERT_EQ(answers.outcomes[i], static_cast<int>(twin.outcome) + 1);
    ASSERT_EQ(answers.axes[i], twin.axis.has_value() ? Index(*twin.axis) + 1 : 0);
    for (std::size_t q = 0; q < kQuantityCount; ++q) {
      const std::string name(Describe(kQuantities[q]).name);
      ExpectNear(answers.values[q][i], twin.values[q], largest[q], name);
      ExpectNear(answers.errors[q][i], twin.standard_errors[q], largest[q], name);
    }
    const PulseUncertainty p95 = WithCoverage(two_sigma, Coverage::kP95);
    const double thu = p95[Quantity::kThu], tvu = p95[Quantity::kTvu];
    const std::optional<S44Order> best = BestOrder(thu, tvu, pulse.depth);
    const bool inside = twin.outcome == Outcome::kInterpolated;
    ASSERT_EQ(answers.best[i], inside && best.has_value() ? static_cast<int>(*best) + 1 : 0);
    if (!query.s44_order.has_value()) {
      ASSERT_TRUE(std::isnan(answers.thu[i]) && std::isnan(answers.tvu[i]));
      continue;
    }
    const double thu_limit = ThuLimit(*query.s44_order, pulse.depth),
                 tvu_limit = TvuLimit(*query.s44_order, pulse.depth);
    ExpectRemaining(answers.thu[i], RemainingBudget(thu_limit, thu), thu_limit);
    ExpectRemaining(answers.tvu[i], RemainingBudget(tvu_limit, tvu), tvu_limit);
  }
}

const std::vector<Query> kQueries = {{},
                                     {.coverage = Coverage::kP95, .s44_order = S44Order::kExclusive},
                                     {.coverage = Coverage::kTwoSigma, .s44_order = S44Order::k1a}};

class ColumnQuery : public testing::OnInstructionSet {};
ALBTPU_ON_EACH_INSTRUCTION_SET(ColumnQuery);

TEST_P(ColumnQuery, AgreesWithTheSlowTwin) {
  for (const UncertaintyTable& table : TablesOfEachKind()) {
    const ColumnInterpolator interpolator(table);
    Columns columns = RandomColumns(table, 3001, 1);
    for (const bool azimuth_absent : {false, true}) {
      if (azimuth_absent) columns[Index(AxisId::kAzimuth)].clear();
      const PulseColumns pulses = Pulses(columns, 3001);
      for (const Query& query : kQueries) ExpectTwin(table, query, pulses, Ask(interpolator, query, pulses));
    }
  }
}

TEST_P(ColumnQuery, AgreesWithTheSlowTwinOnAFlightLine) {
  for (const UncertaintyTable& table : {SyntheticTable(), LogTable(), SyntheticSea()}) {
    const ColumnInterpolator interpolator(table);
    Columns columns = LineColumns(5000);
    for (const bool absent : {false, true}) {
      if (absent) columns[Index(AxisId::kAzimuth)] = columns[Index(AxisId::kFetch)] = {};
      const PulseColumns pulses = Pulses(columns, 5000);
      for (const Query& query : kQueries) ExpectTwin(table, query, pulses, Ask(interpolator, query, pulses));
    }
  }
}

// An answer of the twin lies between the nodes around the pulse, is continuous from cell to cell and grows with a
// coordinate where the nodes do, as it is linear along each axis; so does that of the columns but for rounding.
TEST_P(ColumnQuery, AgreesWithTheSlowTwinOnRandomAxesAndValues) {
  for (const UncertaintyTable& table : RoughTables(12)) {
    const ColumnInterpolator interpolator(table);
    const Columns columns = RandomColumns(table, 800, 1);
    const PulseColumns pulses = Pulses(columns, 800);
    ExpectTwin(table, {}, pulses, Ask(interpolator, {}, pulses));
  }
}

TEST_P(ColumnQuery, IsExactAtEveryNode) {
  for (const UncertaintyTable& table : {SyntheticTable(), LogTable(), TinyTable(Scale::kLog), SyntheticSea()}) {
    const Columns columns = NodeColumns(table);
    const std::size_t size = columns[0].size();
    const Answers answers = Ask(ColumnInterpolator(table), {}, Pulses(columns, size));
    for (Quantity quantity : kQuantities) {
      const Variable& variable = *table.variable(quantity);
      const std::size_t over = Describe(quantity).over_last_axis ? 1 : table.axis(AxisId::kDepth).size();
      for (std::size_t i = 0; i < size; ++i) {
        ASSERT_EQ(answers.values[Index(quantity)][i], variable.values[i / over]) << i;
        ASSERT_EQ(answers.errors[Index(quantity)][i], variable.standard_errors[i / over]) << i;
      }
    }
  }
}

TEST_P(ColumnQuery, HasTheOutcomesOfTheSlowTwinAtEveryCoordinate) {
  for (const UncertaintyTable& table : {SyntheticTable(), TinyTable(), SyntheticSea()}) {
    const ColumnInterpolator interpolator(table);
    Columns columns;
    const auto add = [&](const std::vector<float>& pulse) {
      for (std::size_t axis = 0; axis < kAxisCount; ++axis) columns[axis].push_back(pulse[axis]);
    };
    for (const Axis& axis : table.axes()) {
      const auto first = static_cast<float>(axis.nodes().front()), last = static_cast<float>(axis.nodes().back());
      for (const float x : {kNaN, kInfinity, -kInfinity, -1.0f, -0.0f, 0.0f, first, last, std::nextafter(first, -1.0f),
                            std::nextafter(last, kInfinity), 1e-30f, 1e6f, 1.1e6f, -3e8f, 1e30f}) {
        std::vector<float> pulse = {4, 2e3f, 12, 40, 1, 8};
        add(pulse);
        pulse[Index(axis.id())] = x;
        add(pulse);
        for (const float depth : {-1.0f, kNaN}) {
          pulse[Index(AxisId::kDepth)] = depth;
          add(pulse);
        }
      }
    }
    const std::size_t size = columns[0].size();
    ExpectTwin(table, {}, Pulses(columns, size), Ask(interpolator, {}, Pulses(columns, size)));
    columns[Index(AxisId::kAzimuth)].clear();
    ExpectTwin(table, {}, Pulses(columns, size), Ask(interpolator, {}, Pulses(columns, size)));
  }
}

TEST_P(ColumnQuery, OfOneSeaNeedsNeitherWindNorFetch) {
  const UncertaintyTable table = SyntheticSea();
  const ColumnInterpolator interpolator(table);
  Columns columns = RandomColumns(table, 500, 4);
  columns[Index(AxisId::kWindSpeed)] = columns[Index(AxisId::kFetch)] = {};
  const PulseColumns pulses = Pulses(columns, 500);
  const Answers absent = Ask(interpolator, {}, pulses);
  ExpectTwin(table, {}, pulses, absent);
  EXPECT_GT(std::count(absent.outcomes.begin(), absent.outcomes.end(), 1), 250);
  for (const float wind_speed : {0.0f, 6.5f, 100.0f}) {
    columns[Index(AxisId::kWindSpeed)] = {wind_speed};
    columns[Index(AxisId::kFetch)] = {3e4f};
    const Answers given = Ask(interpolator, {}, Pulses(columns, 500));
    EXPECT_EQ(given.FirstDifference(absent), std::nullopt);
  }
}

// Azimuths are multiples of an eighth of a degree, so that turns do not round.
TEST_P(ColumnQuery, OfOneSeaRepeatsAfterHalfATurnAndHasNoMirror) {
  const UncertaintyTable table = SyntheticSea();
  const ColumnInterpolator interpolator(table);
  const auto answers_at = [&](float azimuth) {
    const Columns columns = {{{}, {}, {12}, {azimuth}, {1}, {8}}};
    return Ask(interpolator, {.coverage = Coverage::kP95, .s44_order = S44Order::k1a}, Pulses(columns, 1)).BitsAt(0);
  };
  for (int eighth = 0; eighth <= 8 * 180; eighth += 35) {
    const auto azimuth = static_cast<float>(eighth) / 8;
    const auto expected = answers_at(azimuth);
    for (const float turned : {azimuth + 180, azimuth - 180, azimuth - 360, azimuth + 3600, azimuth - 7200})
      ASSERT_EQ(answers_at(turned), expected) << azimuth << " and " << turned;
    if (eighth % (8 * 90) != 0) {
      EXPECT_NE(answers_at(-azimuth), expected) << azimuth;
    }
  }
}

TEST_P(ColumnQuery, WritesOnlyTheWantedColumns) {
  const UncertaintyTable table = SyntheticTable();
  const ColumnInterpolator interpolator(table);
  const Columns columns = RandomColumns(table, 600, 3);
  const Answers all = Ask(interpolator, {}, Pulses(columns, 600));
  for (Quantity quantity : kQuantities) {
    std::vector<float> value(600, 77), error(600, 77);
    AnswerColumns wanted;
    wanted.values[Index(quantity)] = value.data();
    interpolator.Interpolate({}, Pulses(columns, 600), 5, 590, wanted);
    wanted.values[Index(quantity)] = nullptr;
    wanted.standard_errors[Index(quantity)] = error.data();
    interpolator.Interpolate({}, Pulses(columns, 600), 5, 590, wanted);
    for (std::size_t i = 0; i < 600; ++i) {
      const bool inside = i >= 5 && i < 590;
      const float outside = 77;
      ASSERT_EQ(std::memcmp(&value[i], inside ? &all.values[Index(quantity)][i] : &outside, sizeof(float)), 0);
      ASSERT_EQ(std::memcmp(&error[i], inside ? &all.errors[Index(quantity)][i] : &outside, sizeof(float)), 0);
    }
  }
}

}  // namespace
}  // namespace albtpu
