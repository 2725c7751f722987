#include "sea/table/table_at_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "sea/angle.h"
#include "sea/response/sea_response.h"
#include "sea/sea_state.h"
#include "sea/table/sea_table.h"
#include "sea/water_index.h"
#include "tables/file/table_io.h"
#include "tables/query/interpolation.h"
#include "tests/sea/table/table_seas.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu {
namespace {

UncertaintyTable CompiledAt(const SeaDescription& sea, double index) {
  static const SeaCompiler compiler;
  return compiler.Compile(sea, 1800, index).value();
}

const Variable& Of(const UncertaintyTable& table, Quantity quantity) { return *table.variable(quantity); }

// Relative differences at all nodes of at least a fiftieth of the greatest value.
struct Differences {
  double rms = 0, worst = 0;
};

Differences Compare(const UncertaintyTable& ours, const UncertaintyTable& exact, Quantity quantity) {
  const std::vector<float>&a = Of(ours, quantity).values, &b = Of(exact, quantity).values;
  float greatest = 0;
  for (const float value : b) greatest = std::max(greatest, std::abs(value));
  Differences found;
  double squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (std::abs(b[i]) < greatest / 50) continue;
    const double difference = a[i] / b[i] - 1.0;
    found.worst = std::max(found.worst, std::abs(difference));
    squares += difference * difference;
    ++count;
  }
  found.rms = std::sqrt(squares / count);
  return found;
}

TEST(TableAtIndex, IsTheSameTableAtItsOwnIndex) {
  const UncertaintyTable table = CompiledAt(SeaOf(6), 1.33);
  EXPECT_EQ(IndexOfTable(table), 1.33);
  const UncertaintyTable same = AtIndex(table, 1.33);
  EXPECT_EQ(same.digest(), table.digest());
  for (const Quantity quantity : kQuantities) EXPECT_EQ(Of(same, quantity).values, Of(table, quantity).values);
}

// Wind seas are those of which tables have many winds.
TEST(TableAtIndex, IsThatOfAWindSeaComputedAtThisIndexWithinATenthOfAPercent) {
  for (const double wind_speed : {3.0, 7.0, 15.0}) {
    const UncertaintyTable table = CompiledAt(SeaOf(wind_speed), 1.33);
    for (const double index : {1.34, 1.345, 1.36}) {
      const UncertaintyTable exact = CompiledAt(SeaOf(wind_speed), index), scaled = AtIndex(table, index);
      EXPECT_EQ(IndexOfTable(scaled), index);
      for (const Quantity quantity : kQuantities) {
        const Differences found = Compare(scaled, exact, quantity);
        EXPECT_LT(found.worst, 1e-3) << wind_speed << " " << index << " " << Describe(quantity).name;
        EXPECT_LT(found.rms, 3e-4) << wind_speed << " " << index << " " << Describe(quantity).name;
      }
    }
  }
}

// On the axes of a sea that crosses another one slopes are correlated, and under a footprint that passes less than a
// hundredth of the slopes, too, which scaling neglects.
TEST(TableAtIndex, IsThatOfAnySeaWithinATenthOfAPercentRms) {
  for (const auto& [name, sea] : TableSeas()) {
    const UncertaintyTable scaled = AtIndex(CompiledAt(sea, 1.33), 1.36), exact = CompiledAt(sea, 1.36);
    for (const Quantity quantity : kQuantities) {
      const Differences found = Compare(scaled, exact, quantity);
      EXPECT_LT(found.rms, 1e-3) << name << " " << Describe(quantity).name;
      EXPECT_LT(found.worst, 6e-3) << name << " " << Describe(quantity).name;
    }
  }
}

TEST(TableAtIndex, ScalesStandardErrorsAsTheirValues) {
  const UncertaintyTable table = CompiledAt(SeaOf(6), 1.33), scaled = AtIndex(table, 1.36);
  for (const Quantity quantity : kQuantities) {
    const Variable &before = Of(table, quantity), &after = Of(scaled, quantity);
    for (std::size_t i = 0; i < before.values.size(); ++i) {
      if (before.values[i] != 0) {
        ASSERT_NEAR(after.standard_errors[i] * before.values[i], before.standard_errors[i] * after.values[i],
                    1e-6 * std::abs(before.standard_errors[i] * after.values[i]));
      }
    }
  }
}

TEST(TableAtIndex, TakesTheIndexOfThePaperWhereATableStatesNone) {
  const UncertaintyTable table = testing::SyntheticTable();
  testing::TableParts parts = testing::PartsOf(table);
  parts.provenance.attributes.erase("refractive_index");
  const UncertaintyTable silent = UncertaintyTable::Create(parts.axes, parts.variables, parts.provenance).value();
  EXPECT_FALSE(StatesIndex(silent));
  EXPECT_EQ(IndexOfTable(silent), kRefractiveIndex);
}

// Water that refracts nothing, and more than any does; values that are interpolated in their logarithm stay positive.
TEST(TableAtIndex, IsAValidTableAtAnyIndex) {
  for (const Scale scale : {Scale::kLinear, Scale::kLog})
    for (const double index : {1.0, 1.2, 2.0}) AtIndex(testing::TinyTable(scale, kSeaSurface), index);
  const UncertaintyTable none = AtIndex(CompiledAt(SeaOf(6), 1.33), 1);
  for (const float thu : Of(none, Quantity::kThu).values) EXPECT_LT(thu, 1e-6);
  AtIndex(testing::SyntheticTable({.published = true}), 1.34);
}

// The table that ships, between its nodes: at another index it is as near to the theory as at its own.
TEST(TableAtIndex, KeepsTheAgreementOfTheShippedTable) {
  const UncertaintyTable table = ReadTable(SHIPPED_SURVEY).value();
  ASSERT_TRUE(StatesIndex(table));
  std::mt19937 random(4);
  const auto between = [&](float a, float b) { return std::uniform_real_distribution<float>(a, b)(random); };
  std::vector<Pulse> pulses;
  std::vector<HarmonicSpectrum> seas;
  for (int i = 0; i < 12; ++i) {
    pulses.push_back({.wind_speed = between(3, 14),
                      .incidence = between(1, 25),
                      .azimuth = between(0, 90),
                      .footprint = between(0.2f, 2),
                      .depth = between(1, 40)});
    const WindSea wind{.wind_speed_10m = pulses.back().wind_speed, .model = &kElfouhailyModel};
    seas.push_back(Sampled(*wind.MakeSpectrum(), SeaWavenumbers(), 3));
  }
  for (const double index : {1.34, 1.345, 1.36}) {
    const UncertaintyTable scaled = AtIndex(table, index);
    for (std::size_t i = 0; i < pulses.size(); ++i) {
      const Pulse& pulse = pulses[i];
      const BeamOptions beam{.incidence = RadiansOfDegrees(pulse.incidence),
                             .azimuth = RadiansOfDegrees(*pulse.azimuth),
                             .footprint = pulse.footprint};
      const auto theory = [&](double n) {
        const BeamResponse response = SeaResponse(seas[i], n)(beam);
        return std::array<double, 6>{response.refraction_along_wind(),    response.refraction_cross_wind(),
                                     response.Thu(pulse.depth),           response.Tvu(pulse.depth),
                                     response.BiasAlongBeam(pulse.depth), response.BiasVertical(pulse.depth)};
      };
      const std::array<double, 6> from = theory(IndexOfTable(table)), to = theory(index);
      const PulseUncertainty before = Interpolate(table, pulse), after = Interpolate(scaled, pulse);
      for (const Quantity quantity : kQuantities) {
        const std::size_t q = Index(quantity);
        EXPECT_NEAR((after.values[q] / before.values[q]) / (to[q] / from[q]), 1, 1e-3)
            << index << " " << i << " " << Describe(quantity).name;
      }
    }
  }
}

}  // namespace
}  // namespace albtpu
