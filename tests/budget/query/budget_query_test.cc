// The whole budget from a table, held against its parts: the interpolator and the sums.
#include "budget/query/budget_query.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "budget/query/query_check.h"
#include "tests/budget/query/budget_memory.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu {
namespace {

using testing::BudgetMemory;
using testing::BudgetPulseMemory;
using ::testing::HasSubstr;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class BudgetQueries : public ::testing::Test {
 protected:
  BudgetMemory Ask(const BudgetPulseMemory& pulses, const BudgetOptions& options = testing::UsualOptions()) const {
    const BudgetPulses columns = pulses.columns();
    EXPECT_TRUE(CheckQuery(kSeaSurface, columns, options).ok()) << CheckQuery(kSeaSurface, columns, options);
    BudgetMemory answers(columns.pulses.size);
    QueryBudgetOnAllCores(interpolator_, columns, options, answers.columns());
    return answers;
  }

  const ColumnInterpolator interpolator_{testing::SyntheticTable()};
};

std::vector<int> Outcomes(const BudgetMemory& answers) { return {answers.outcomes.begin(), answers.outcomes.end()}; }

TEST_F(BudgetQueries, AddTheShareOfTheTableToThoseOfTheAircraft) {
  const BudgetPulseMemory pulses = testing::RandomBudgetPulses(1000);
  const BudgetMemory answers = Ask(pulses);
  // The parts, one after the other.
  std::vector<float> thu(1000), tvu(1000), along(1000), cross(1000), total_thu(1000), total_tvu(1000);
  AnswerColumns sea;
  sea.values[Index(Quantity::kThu)] = thu.data();
  sea.values[Index(Quantity::kTvu)] = tvu.data();
  sea.values[Index(Quantity::kRefractionAlongWind)] = along.data();
  sea.values[Index(Quantity::kRefractionCrossWind)] = cross.data();
  const BudgetPulses columns = pulses.columns();
  InterpolateOnAllCores(interpolator_, Query(), columns.pulses, sea);
  BudgetInputs inputs = columns.aircraft;
  const float axis = 250;
  inputs[BudgetInput::kIncidence] = columns.pulses[AxisId::kIncidence];
  inputs[BudgetInput::kDepth] = columns.pulses[AxisId::kDepth];
  inputs[BudgetInput::kSeaThu] = thu;
  inputs[BudgetInput::kSeaTvu] = tvu;
  inputs[BudgetInput::kRefractionAlong] = along;
  inputs[BudgetInput::kRefractionCross] = cross;
  inputs[BudgetInput::kSeaAxis] = {&axis, 1};
  ComputeBudget(inputs, testing::UsualOptions(), {.thu = total_thu, .tvu = total_tvu});
  for (std::size_t i = 0; i < 1000; ++i) {
    ASSERT_EQ(answers.outcomes[i], 1);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(answers.at(BudgetQuantity::kTotalThu, i)),
              std::bit_cast<std::uint32_t>(total_thu[i]));
    EXPECT_EQ(std::bit_cast<std::uint32_t>(answers.at(BudgetQuantity::kTotalTvu, i)),
              std::bit_cast<std::uint32_t>(total_tvu[i]));
  }
}

TEST_F(BudgetQueries, HaveTheSameBitsOnAllCoresAndOneByOne) {
  const BudgetPulseMemory pulses = testing::RandomBudgetPulses(40000);
  const BudgetMemory together = Ask(pulses);
  const BudgetPulses columns = pulses.columns();
  for (const std::size_t i : {0, 1, 8191, 8192, 20000, 39999}) {
    BudgetMemory alone(1);
    QueryBudgetOnAllCores(interpolator_, Slice(columns, i, 1), testing::UsualOptions(), alone.columns());
    for (std::size_t c = 0; c < kBudgetColumnCount; ++c) {
      EXPECT_EQ(std::bit_cast<std::uint32_t>(together.numbers[c][i]),
                std::bit_cast<std::uint32_t>(alone.numbers[c][0]));
    }
    EXPECT_EQ(together.best_s44_orders[i], alone.best_s44_orders[0]);
  }
}

TEST_F(BudgetQueries, RefuseThePulseWhoseAircraftHasAnInvalidNumber) {
  for (const BudgetInput input : kAircraftInputs) {
    for (const float number : {kNaN, kInfinity, -kInfinity, 2e6f}) {
      BudgetPulseMemory pulses = testing::RandomBudgetPulses(3);
      pulses[input] = {1, number, 1};
      const BudgetMemory answers = Ask(pulses);
      EXPECT_EQ(Outcomes(answers), (std::vector<int>{1, 3, 1})) << static_cast<int>(input) << " " << number;
      EXPECT_EQ(answers.outcome_axes[1], 0);
      for (const std::vector<float>& column : answers.numbers) {
        EXPECT_FALSE(std::isnan(column[0]));
        EXPECT_TRUE(std::isnan(column[1]));
      }
      EXPECT_EQ(answers.best_s44_orders[1], 0);
    }
  }
}

TEST_F(BudgetQueries, RefuseANegativeSigmaAndAnAltitudeOfZero) {
  for (const auto& [input, number, outcome] :
       std::vector<std::tuple<BudgetInput, float, int>>{{BudgetInput::kPositionSigmaDown, -0.01f, 3},
                                                        {BudgetInput::kHeadingSigma, -1e-40f, 3},
                                                        {BudgetInput::kHeadingSigma, 0.0f, 1},
                                                        {BudgetInput::kWaveHeight, -1.0f, 3},
                                                        {BudgetInput::kWaveHeight, -0.0f, 1},
                                                        {BudgetInput::kAltitude, 0.0f, 3},
                                                        {BudgetInput::kAltitude, -400.0f, 3},
                                                        {BudgetInput::kRoll, -20.0f, 1}}) {
    BudgetPulseMemory pulses = testing::RandomBudgetPulses(3);
    pulses[input] = {number};  // For all.
    EXPECT_EQ(Outcomes(Ask(pulses)), std::vector<int>(3, outcome)) << number;
  }
}

TEST_F(BudgetQueries, KeepTheOutcomeOfTheTableWhereItHasNoAnswer) {
  BudgetPulseMemory pulses = testing::RandomBudgetPulses(3);
  pulses.axes[Index(AxisId::kDepth)] = {1, 30, kNaN};
  pulses[BudgetInput::kAltitude] = {400, -1, 400};
  const BudgetMemory answers = Ask(pulses);
  EXPECT_EQ(Outcomes(answers), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(answers.outcome_axes[1], static_cast<int>(Index(AxisId::kDepth)) + 1);
  EXPECT_EQ(answers.outcome_axes[2], static_cast<int>(Index(AxisId::kDepth)) + 1);
  for (const std::vector<float>& column : answers.numbers) EXPECT_TRUE(std::isnan(column[1]) && std::isnan(column[2]));
}

TEST_F(BudgetQueries, CompareWithS44WithoutABiasThatTheTableLacks) {
  const ColumnInterpolator published(testing::SyntheticTable({.published = true}));
  const BudgetPulseMemory pulses = testing::RandomBudgetPulses(100);
  BudgetMemory answers(100);
  QueryBudgetOnAllCores(published, pulses.columns(), testing::UsualOptions(), answers.columns());
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_TRUE(std::isnan(answers.at(BudgetQuantity::kBiasVertical, i)));
    EXPECT_GT(answers.best_s44_orders[i], 0);
  }
}

// As files do (annotate/totals/water_column.h).
TEST_F(BudgetQueries, StateTheBiasOfTheWaterWhereTheTableLacksThatOfTheSea) {
  const ColumnInterpolator published(testing::SyntheticTable({.published = true}));
  BudgetPulseMemory pulses = testing::RandomBudgetPulses(100);
  pulses[BudgetInput::kWaterBiasAlong] = {0.25f};
  pulses[BudgetInput::kWaterBiasVertical] = {-30};
  BudgetMemory answers(100);
  QueryBudgetOnAllCores(published, pulses.columns(), testing::UsualOptions(), answers.columns());
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(answers.at(BudgetQuantity::kBiasAlongBeam, i), 0.25f);
    EXPECT_EQ(answers.at(BudgetQuantity::kBiasVertical, i), -30);
    EXPECT_EQ(answers.best_s44_orders[i], 0);  // None allows 30 m.
  }
}

TEST_F(BudgetQueries, AreFiniteAtTheGreatestNumbers) {
  BudgetPulseMemory pulses = testing::RandomBudgetPulses(100);
  const auto greatest = static_cast<float>(kGreatestBudgetNumber);
  for (const BudgetInput input : kAircraftInputs) pulses[input] = {greatest};
  BudgetOptions options = testing::UsualOptions();
  options.errors = {.position = {1e6, 1e6, 1e6},
                    .attitude = {1e6, 1e6, 1e6},
                    .boresight = {1e6, 1e6, 1e6},
                    .lever_arm = 1e6,
                    .scan = 1e6,
                    .time = 1e6,
                    .range_offset = 1e6,
                    .bottom_range = 1e6,
                    .surface_height = 1e6,
                    .index = 1e6};
  options.lever_arm = {1e6, -1e6, 1e6};
  options.datum = 1e6;
  const BudgetMemory answers = Ask(pulses, options);
  for (const std::vector<float>& column : answers.numbers)
    for (const float number : column) EXPECT_TRUE(std::isfinite(number));
}

TEST_F(BudgetQueries, AreRefusedWithOptionsOutOfRange) {
  const BudgetPulseMemory pulses = testing::RandomBudgetPulses(3);
  const auto message = [&](const auto& change) {
    BudgetOptions options = testing::UsualOptions();
    change(options);
    return std::string(CheckQuery(kSeaSurface, pulses.columns(), options).message());
  };
  EXPECT_THAT(message([](auto& o) { o.errors.position[2] = -1; }), HasSubstr("errors.position.down is -1"));
  EXPECT_THAT(message([](auto& o) { o.errors.scan = NAN; }), HasSubstr("errors.scan is nan"));
  EXPECT_THAT(message([](auto& o) { o.errors.index = INFINITY; }), HasSubstr("errors.index is inf"));
  EXPECT_THAT(message([](auto& o) { o.lever_arm[1] = NAN; }), HasSubstr("lever_arm.right is nan"));
  EXPECT_THAT(message([](auto& o) { o.index = 0.99; }), HasSubstr("refractive_index is 0.99: expected 1 to 2"));
  EXPECT_THAT(message([](auto& o) { o.index = NAN; }), HasSubstr("refractive_index is nan"));
  EXPECT_THAT(message([](auto& o) { o.datum = -0.1; }), HasSubstr("datum is -0.1"));
  EXPECT_EQ(message([](auto& o) { o.index = 2; }), "");
}

TEST_F(BudgetQueries, AreRefusedWithColumnsOfOtherLengths) {
  BudgetPulseMemory pulses = testing::RandomBudgetPulses(3);
  pulses[BudgetInput::kRoll] = {1, 2};
  EXPECT_THAT(CheckQuery(kSeaSurface, pulses.columns(), testing::UsualOptions()).message(),
              HasSubstr("column 'roll' has 2 numbers for 3 pulses"));
  pulses = testing::RandomBudgetPulses(3);
  pulses[BudgetInput::kBeamAzimuth].clear();
  EXPECT_THAT(CheckQuery(kSeaSurface, pulses.columns(), testing::UsualOptions()).message(),
              HasSubstr("column 'beam_azimuth' is empty"));
}

}  // namespace
}  // namespace albtpu
