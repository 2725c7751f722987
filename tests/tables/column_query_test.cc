#include "tables/column_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/instruction_sets.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu {
namespace {

using ::albtpu::testing::SyntheticTable;
using ::albtpu::testing::TinyTable;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kTolerance = 1e-5;  // relative
constexpr double kCancelled = 4e-7;  // of the largest value of a quantity

using Columns = std::array<std::vector<float>, kAxisCount>;

PulseColumns Pulses(const Columns& columns, std::size_t size) {
  PulseColumns pulses{.size = size, .axis = {}};
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) pulses.axis[axis] = columns[axis];
  return pulses;
}

// All that can be answered, of one query.
struct Answers {
  explicit Answers(std::size_t size) : outcomes(size), axes(size), best(size), thu(size), tvu(size) {
    for (std::size_t q = 0; q < kQuantityCount; ++q) {
      values[q].resize(size);
      errors[q].resize(size);
    }
  }
  AnswerColumns columns() {
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
  std::vector<std::uint32_t> BitsAt(std::size_t i) const {
    std::vector<std::uint32_t> row = {outcomes[i], axes[i], best[i], std::bit_cast<std::uint32_t>(thu[i]),
                                      std::bit_cast<std::uint32_t>(tvu[i])};
    for (std::size_t q = 0; q < kQuantityCount; ++q) {
      row.push_back(std::bit_cast<std::uint32_t>(values[q][i]));
      row.push_back(std::bit_cast<std::uint32_t>(errors[q][i]));
    }
    return row;
  }

  std::vector<std::uint8_t> outcomes, axes, best;
  std::array<std::vector<float>, kQuantityCount> values, errors;
  std::vector<float> thu, tvu;
};

Answers Ask(const ColumnInterpolator& interpolator, const Query& query, const PulseColumns& pulses) {
  Answers answers(pulses.size);
  interpolator.Answer(query, pulses, 0, pulses.size, answers.columns());
  return answers;
}

double Largest(const std::vector<float>& numbers) {
  double largest = 0;
  for (float number : numbers) largest = std::max(largest, std::abs(static_cast<double>(number)));
  return largest;
}

// Where corners of both signs cancel, or the one of 0 has almost all the weight, what counts is the largest.
void ExpectNear(float ours, double exact, double largest, const std::string& what) {
  if (std::isnan(exact)) {
    ASSERT_TRUE(std::isnan(ours)) << what << " is " << ours;
  } else {
    ASSERT_NEAR(ours, exact, kTolerance * std::abs(exact) + kCancelled * largest) << what;
  }
}

// Where little is left of a limit, it is the difference of larger numbers.
void ExpectRemaining(float ours, std::optional<double> exact, double limit) {
  ASSERT_EQ(std::isnan(ours), !exact.has_value());
  if (!exact.has_value()) return;
  ASSERT_NEAR(ours * ours, *exact * *exact, kTolerance * limit * limit);
}

// As the slow twin answers, a pulse at a time.
void ExpectTwin(const UncertaintyTable& table, const Query& query, const PulseColumns& pulses,
                const Answers& answers) {
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

// Uniform between a little outside the axes; few are not numbers.
Columns RandomColumns(const UncertaintyTable& table, std::size_t size, std::uint32_t seed) {
  std::mt19937 random(seed);
  Columns columns;
  for (const Axis& axis : table.axes()) {
    const double first = axis.nodes().front(), last = axis.nodes().back(), beyond = 0.01 * (last - first);
    std::uniform_real_distribution<double> coordinate(first - beyond, last + beyond);
    for (std::size_t i = 0; i < size; ++i) {
      double x = axis.size() == 1 ? first : coordinate(random);
      if (random() % 8 == 0) x = axis.nodes()[random() % axis.size()];
      if (random() % 400 == 0) x = kNaN;
      if (random() % 400 == 0) x = kInfinity;
      columns[Index(axis.id())].push_back(static_cast<float>(x));
    }
  }
  return columns;
}

// A flight line, which stays in cells of the table.
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

std::vector<UncertaintyTable> Tables() {
  return {SyntheticTable(), SyntheticTable({.published = true}), LogTable(), TinyTable(),
          TinyTable(Scale::kLog)};
}

const std::vector<Query> kQueries = {{},
                                     {.coverage = Coverage::kP95, .s44_order = S44Order::kExclusive},
                                     {.coverage = Coverage::kTwoSigma, .s44_order = S44Order::k1a}};

class ColumnQuery : public testing::OnInstructionSet {};
ALBTPU_ON_EACH_INSTRUCTION_SET(ColumnQuery);

TEST_P(ColumnQuery, AnswersAsTheSlowTwin) {
  for (const UncertaintyTable& table : Tables()) {
    const ColumnInterpolator interpolator(table);
    Columns columns = RandomColumns(table, 3001, 1);
    for (const bool azimuth_absent : {false, true}) {
      if (azimuth_absent) columns[Index(AxisId::kAzimuth)].clear();
      const PulseColumns pulses = Pulses(columns, 3001);
      for (const Query& query : kQueries) ExpectTwin(table, query, pulses, Ask(interpolator, query, pulses));
    }
  }
}

TEST_P(ColumnQuery, AnswersAFlightLineAsTheSlowTwin) {
  for (const UncertaintyTable& table : {SyntheticTable(), LogTable()}) {
    const ColumnInterpolator interpolator(table);
    Columns columns = LineColumns(5000);
    for (const bool absent : {false, true}) {
      if (absent) columns[Index(AxisId::kAzimuth)] = columns[Index(AxisId::kFetch)] = {};
      const PulseColumns pulses = Pulses(columns, 5000);
      for (const Query& query : kQueries) ExpectTwin(table, query, pulses, Ask(interpolator, query, pulses));
    }
  }
}

TEST_P(ColumnQuery, IsExactAtEveryNode) {
  for (const UncertaintyTable& table : {SyntheticTable(), LogTable(), TinyTable(Scale::kLog)}) {
    const std::size_t size = ValueCount(table.axes(), Quantity::kThu);
    Columns columns;
    for (std::size_t i = 0; i < size; ++i) {
      std::size_t rest = i;
      for (std::size_t axis = kAxisCount; axis-- > 0;) {
        const std::vector<double>& nodes = table.axes()[axis].nodes();
        columns[axis].push_back(static_cast<float>(nodes[rest % nodes.size()]));
        rest /= nodes.size();
      }
    }
    const Answers answers = Ask(ColumnInterpolator(table), {}, Pulses(columns, size));
    for (Quantity quantity : kQuantities) {
      const Variable& variable = *table.variable(quantity);
      const std::size_t over = Describe(quantity).over_depth ? 1 : table.axis(AxisId::kDepth).size();
      for (std::size_t i = 0; i < size; ++i) {
        ASSERT_EQ(answers.values[Index(quantity)][i], variable.values[i / over]) << i;
        ASSERT_EQ(answers.errors[Index(quantity)][i], variable.standard_errors[i / over]) << i;
      }
    }
  }
}

TEST_P(ColumnQuery, GivesEveryCoordinateTheOutcomeOfTheSlowTwin) {
  for (const UncertaintyTable& table : {SyntheticTable(), TinyTable()}) {
    const ColumnInterpolator interpolator(table);
    Columns columns;
    const auto add = [&](const std::vector<float>& pulse) {
      for (std::size_t axis = 0; axis < kAxisCount; ++axis) columns[axis].push_back(pulse[axis]);
    };
    for (const Axis& axis : table.axes()) {
      const auto first = static_cast<float>(axis.nodes().front()),
                 last = static_cast<float>(axis.nodes().back());
      for (const float x :
           {kNaN, kInfinity, -kInfinity, -1.0f, -0.0f, 0.0f, first, last, std::nextafter(first, -1.0f),
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

TEST_P(ColumnQuery, AnswersAPulseAloneAsAmongOthersBitByBit) {
  const Query query{.coverage = Coverage::kP95, .s44_order = S44Order::kSpecial};
  for (const UncertaintyTable& table : Tables()) {
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

TEST_P(ColumnQuery, AnswersInAnyOrderAndInPiecesBitByBit) {
  const UncertaintyTable table = SyntheticTable();
  const ColumnInterpolator interpolator(table);
  Columns columns = LineColumns(2000);
  const Answers forward = Ask(interpolator, {}, Pulses(columns, 2000));
  Answers pieces(2000);
  const std::vector<std::size_t> cuts = {0, 0, 1, 9, 300, 557, 1999, 2000};
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    interpolator.Answer({}, Pulses(columns, 2000), cuts[i], cuts[i + 1], pieces.columns());
  }
  for (std::vector<float>& column : columns) {
    column.resize(2000, column.front());  // Also those of one number.
    std::reverse(column.begin(), column.end());
  }
  const Answers backward = Ask(interpolator, {}, Pulses(columns, 2000));
  for (std::size_t i = 0; i < 2000; ++i) {
    ASSERT_EQ(pieces.BitsAt(i), forward.BitsAt(i));
    ASSERT_EQ(backward.BitsAt(1999 - i), forward.BitsAt(i));
  }
}

TEST_P(ColumnQuery, WritesWhatIsWantedAndNothingElse) {
  const UncertaintyTable table = SyntheticTable();
  const ColumnInterpolator interpolator(table);
  const Columns columns = RandomColumns(table, 600, 3);
  const Answers all = Ask(interpolator, {}, Pulses(columns, 600));
  for (Quantity quantity : kQuantities) {
    std::vector<float> value(600, 77), error(600, 77);
    AnswerColumns wanted;
    wanted.values[Index(quantity)] = value.data();
    interpolator.Answer({}, Pulses(columns, 600), 5, 590, wanted);
    wanted.values[Index(quantity)] = nullptr;
    wanted.standard_errors[Index(quantity)] = error.data();
    interpolator.Answer({}, Pulses(columns, 600), 5, 590, wanted);
    for (std::size_t i = 0; i < 600; ++i) {
      const bool inside = i >= 5 && i < 590;
      const float outside = 77;
      ASSERT_EQ(std::memcmp(&value[i], inside ? &all.values[Index(quantity)][i] : &outside, sizeof(float)),
                0);
      ASSERT_EQ(std::memcmp(&error[i], inside ? &all.errors[Index(quantity)][i] : &outside, sizeof(float)),
                0);
    }
  }
}

TEST_P(ColumnQuery, OnAllCoresAnswersBitByBitAsOnOne) {
  const ColumnInterpolator interpolator(SyntheticTable());
  const Columns columns = LineColumns(20001);
  const Answers one = Ask(interpolator, {}, Pulses(columns, 20001));
  Answers all(20001);
  AnswerOnAllCores(interpolator, {}, Pulses(columns, 20001), all.columns());
  for (std::size_t i = 0; i < 20001; ++i) ASSERT_EQ(all.BitsAt(i), one.BitsAt(i));
}

}  // namespace
}  // namespace albtpu
