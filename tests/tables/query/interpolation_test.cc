#include "tables/query/interpolation.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "tests/tables/query/asked_columns.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu {
namespace {

using ::albtpu::testing::MakeAxis;
using ::albtpu::testing::SyntheticTable;
using ::albtpu::testing::TinyTable;

using ::albtpu::testing::kInfinity;
using ::albtpu::testing::kNaN;

// A result is rounded to single precision once, by at most half an ulp. Twice that allows for the errors of the
// double arithmetic before.
constexpr float kRounding = std::numeric_limits<float>::epsilon();

Pulse Typical() {
  return {.wind_speed = 6, .fetch = 5e3f, .incidence = 12, .azimuth = 40.0f, .footprint = 0.6f, .depth = 8};
}

UncertaintyTable TinyTableWith(const Axis& axis) {
  testing::TableParts parts = testing::PartsOf(TinyTable());
  parts.axes[Index(axis.id())] = axis;
  return parts.Create().value();
}

float& Coordinate(Pulse& pulse, AxisId axis) {
  switch (axis) {
    case AxisId::kWindSpeed:
      return pulse.wind_speed;
    case AxisId::kFetch:
      return pulse.fetch;
    case AxisId::kIncidence:
      return pulse.incidence;
    case AxisId::kAzimuth:
      return *pulse.azimuth;
    case AxisId::kFootprint:
      return pulse.footprint;
    case AxisId::kDepth:
      break;
  }
  return pulse.depth;
}

void ExpectNoNumbers(const PulseUncertainty& uncertainty) {
  for (float value : uncertainty.values) EXPECT_TRUE(std::isnan(value));
  for (float value : uncertainty.standard_errors) EXPECT_TRUE(std::isnan(value));
}

// A slow, obvious twin: recursion over one axis after the other.
double Oracle(const UncertaintyTable& table, const std::vector<float>& values, Scale scale, Pulse pulse,
              std::size_t dimensions, std::size_t dimension = 0, std::size_t index = 0) {
  if (dimension == dimensions) return scale == Scale::kLog ? std::log(values[index]) : values[index];
  const Axis& axis = table.axes()[dimension];
  const auto below = [&](std::size_t node) {
    return Oracle(table, values, scale, pulse, dimensions, dimension + 1, index * axis.size() + node);
  };
  if (axis.size() == 1) return below(0);
  const double x = std::min<double>(Coordinate(pulse, axis.id()), axis.nodes().back());
  std::size_t i = 0;
  while (i + 2 < axis.size() && x > axis.nodes()[i + 1]) ++i;
  const double a = axis.nodes()[i], b = axis.nodes()[i + 1];
  const double f = axis.scale() == Scale::kLog ? std::log(x / a) / std::log(b / a) : (x - a) / (b - a);
  return below(i) * (1 - f) + below(i + 1) * f;
}

void ExpectOracle(const UncertaintyTable& table, const Pulse& pulse) {
  const PulseUncertainty result = Interpolate(table, pulse);
  ASSERT_EQ(result.outcome, Outcome::kInterpolated) << OutcomeText(result);
  for (Quantity quantity : kQuantities) {
    const Variable& variable = *table.variable(quantity);
    const std::size_t dimensions = Describe(quantity).over_last_axis ? 6 : 5;
    double value = Oracle(table, variable.values, variable.scale, pulse, dimensions);
    if (variable.scale == Scale::kLog) value = std::exp(value);
    EXPECT_NEAR(result[quantity], value, kRounding * std::abs(value)) << Describe(quantity).name;
    const double error = Oracle(table, variable.standard_errors, Scale::kLinear, pulse, dimensions);
    EXPECT_NEAR(result.standard_errors[Index(quantity)], error, kRounding * error) << Describe(quantity).name;
  }
}

Pulse RandomPulse(const UncertaintyTable& table, std::mt19937& random) {
  Pulse pulse = Typical();
  for (const Axis& axis : table.axes()) {
    std::uniform_real_distribution<float> coordinate(static_cast<float>(axis.nodes().front()),
                                                     static_cast<float>(axis.nodes().back()));
    Coordinate(pulse, axis.id()) = coordinate(random);
  }
  return pulse;
}

TEST(Interpolation, AgreesWithItsSlowTwin) {
  const UncertaintyTable table = SyntheticTable();
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) ExpectOracle(table, RandomPulse(table, random));
}

TEST(Interpolation, OfLogarithmsAgreesWithItsSlowTwin) {
  const UncertaintyTable table = TinyTable(Scale::kLog);
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) ExpectOracle(table, RandomPulse(table, random));
}

TEST(Interpolation, IsExactAtEveryNode) {
  for (const UncertaintyTable& table : {SyntheticTable(), TinyTable(Scale::kLog)}) {
    const testing::Columns nodes = testing::NodeColumns(table);
    const std::size_t size = nodes[0].size(), depths = table.axis(AxisId::kDepth).size();
    for (std::size_t i = 0; i < size; ++i) {
      const PulseUncertainty result = Interpolate(table, PulseAt(testing::Pulses(nodes, size), i));
      for (Quantity quantity : kQuantities) {
        const std::size_t index = Describe(quantity).over_last_axis ? i : i / depths;
        ASSERT_EQ(result[quantity], table.variable(quantity)->values[index]) << i;
        ASSERT_EQ(result.standard_errors[Index(quantity)], table.variable(quantity)->standard_errors[index]) << i;
      }
    }
  }
}

TEST(Interpolation, OfALogVariableIsTheGeometricMeanHalfway) {
  const UncertaintyTable table = TinyTable(Scale::kLog);  // Values are 1 + wind_speed + index of the quantity.
  const Pulse pulse = {.wind_speed = 3, .incidence = 0, .azimuth = 0.0f, .footprint = 1, .depth = 0};
  EXPECT_FLOAT_EQ(Interpolate(table, pulse)[Quantity::kThu], std::sqrt(5.0f * 7.0f));
  EXPECT_FLOAT_EQ(Interpolate(TinyTable(), pulse)[Quantity::kThu], 6);
}

TEST(Interpolation, FindsANodeGivenInSinglePrecision) {
  const UncertaintyTable table = TinyTableWith(MakeAxis(AxisId::kFootprint, {0.1}));
  const Pulse pulse = {.wind_speed = 3, .incidence = 5, .azimuth = 10.0f, .footprint = 0.1f, .depth = 1};
  EXPECT_EQ(Interpolate(table, pulse).outcome, Outcome::kInterpolated);
}

TEST(Interpolation, NamesTheAxisThatThePulseIsOutsideOf) {
  const UncertaintyTable table = SyntheticTable();
  const auto outcome = [&](AxisId axis, float coordinate) {
    Pulse pulse = Typical();
    Coordinate(pulse, axis) = coordinate;
    const PulseUncertainty result = Interpolate(table, pulse);
    ExpectNoNumbers(result);
    return OutcomeText(result);
  };
  EXPECT_EQ(outcome(AxisId::kWindSpeed, 2.99f), "OUT_OF_DOMAIN:wind_speed:below");
  EXPECT_EQ(outcome(AxisId::kWindSpeed, -5), "OUT_OF_DOMAIN:wind_speed:below");
  EXPECT_EQ(outcome(AxisId::kFetch, 999), "OUT_OF_DOMAIN:fetch:below");
  EXPECT_EQ(outcome(AxisId::kFetch, -1000), "OUT_OF_DOMAIN:fetch:below");
  EXPECT_EQ(outcome(AxisId::kIncidence, 25.1f), "OUT_OF_DOMAIN:incidence:above");
  EXPECT_EQ(outcome(AxisId::kIncidence, -1), "OUT_OF_DOMAIN:incidence:below");
  EXPECT_EQ(outcome(AxisId::kFootprint, 0), "OUT_OF_DOMAIN:footprint:below");
  EXPECT_EQ(outcome(AxisId::kFootprint, -0.5f), "OUT_OF_DOMAIN:footprint:below");
  EXPECT_EQ(outcome(AxisId::kDepth, 20.01f), "OUT_OF_DOMAIN:depth:above");
  EXPECT_EQ(outcome(AxisId::kDepth, -0.01f), "OUT_OF_DOMAIN:depth:below");
}

TEST(Interpolation, IsInvalidWhereACoordinateIsNotFinite) {
  const UncertaintyTable table = SyntheticTable();
  for (AxisId axis : kAxes) {
    for (float coordinate : {kNaN, -kInfinity, kInfinity}) {
      if (axis == AxisId::kFetch && coordinate == kInfinity) continue;
      Pulse pulse = Typical();
      Coordinate(pulse, axis) = coordinate;
      const PulseUncertainty result = Interpolate(table, pulse);
      EXPECT_EQ(OutcomeText(result), "INVALID");
      EXPECT_EQ(result.axis, axis);
      ExpectNoNumbers(result);
    }
  }
}

TEST(Interpolation, ReportsInvalidBeforeOutOfDomainAndThenTheFirstAxis) {
  const UncertaintyTable table = SyntheticTable();
  Pulse pulse = Typical();
  pulse.incidence = 80;
  pulse.depth = 80;
  EXPECT_EQ(OutcomeText(Interpolate(table, pulse)), "OUT_OF_DOMAIN:incidence:above");
  pulse.depth = kNaN;
  EXPECT_EQ(Interpolate(table, pulse).outcome, Outcome::kInvalid);
  EXPECT_EQ(Interpolate(table, pulse).axis, AxisId::kDepth);
  pulse.wind_speed = kNaN;
  EXPECT_EQ(Interpolate(table, pulse).axis, AxisId::kWindSpeed);
}

TEST(Interpolation, WithoutAzimuthGivesTheLargerOfDownwindAndCrosswind) {
  const UncertaintyTable table = SyntheticTable();
  Pulse downwind = Typical(), crosswind = Typical(), unknown = Typical();
  downwind.azimuth = 0.0f;
  crosswind.azimuth = 90.0f;
  unknown.azimuth.reset();
  const PulseUncertainty at_0 = Interpolate(table, downwind), at_90 = Interpolate(table, crosswind);
  const PulseUncertainty result = Interpolate(table, unknown);
  EXPECT_TRUE(result.azimuth_absent);
  EXPECT_EQ(result.outcome, Outcome::kInterpolated);
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    const bool crosswind_larger = std::abs(at_90.values[i]) > std::abs(at_0.values[i]);
    EXPECT_EQ(result.values[i], (crosswind_larger ? at_90 : at_0).values[i]);
    EXPECT_EQ(result.standard_errors[i], (crosswind_larger ? at_90 : at_0).standard_errors[i]);
  }
  // Both cases occur, and the negative bias along the beam is compared by its magnitude.
  EXPECT_EQ(result[Quantity::kRefractionAlongWind], at_0[Quantity::kRefractionAlongWind]);
  EXPECT_EQ(result[Quantity::kRefractionCrossWind], at_90[Quantity::kRefractionCrossWind]);
  EXPECT_LT(result[Quantity::kBiasAlongBeam], 0);
}

TEST(Interpolation, WithoutAzimuthNeedsBothEndsOfTheAxis) {
  const UncertaintyTable table = TinyTableWith(MakeAxis(AxisId::kAzimuth, {0, 45}));
  Pulse pulse = {.wind_speed = 3, .incidence = 5, .azimuth = {}, .footprint = 1, .depth = 1};
  const PulseUncertainty result = Interpolate(table, pulse);
  EXPECT_EQ(OutcomeText(result), "OUT_OF_DOMAIN:azimuth");
  EXPECT_TRUE(result.azimuth_absent);
  ExpectNoNumbers(result);
  pulse.depth = 99;  // Azimuth comes before depth.
  EXPECT_EQ(OutcomeText(Interpolate(table, pulse)), "OUT_OF_DOMAIN:azimuth");
  pulse.wind_speed = 99;
  EXPECT_EQ(OutcomeText(Interpolate(table, pulse)), "OUT_OF_DOMAIN:wind_speed:above");
}

TEST(Interpolation, HasNoNumbersForQuantitiesThatTheTableLacks) {
  const UncertaintyTable table = SyntheticTable({.published = true});
  for (const std::optional<float> azimuth : {std::optional<float>(40.0f), std::optional<float>()}) {
    Pulse pulse = Typical();
    pulse.azimuth = azimuth;
    const PulseUncertainty result = Interpolate(table, pulse);
    EXPECT_EQ(result.outcome, Outcome::kInterpolated);
    EXPECT_GT(result[Quantity::kThu], 0);
    EXPECT_TRUE(std::isnan(result[Quantity::kBiasAlongBeam]));
    EXPECT_TRUE(std::isnan(result[Quantity::kBiasVertical]));
    for (float error : result.standard_errors) EXPECT_TRUE(std::isnan(error));
  }
}

}  // namespace
}  // namespace albtpu
