#include "annotate/totals/source_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "annotate/totals/pulse_totals.h"

namespace albtpu::annotate {
namespace {

PulseBatch Pulses(std::size_t size) {
  PulseBatch pulses{.size = size, .axis = {}};
  pulses[AxisId::kIncidence] = {20};
  for (std::size_t i = 0; i < size; ++i) pulses[AxisId::kDepth].push_back(2 + 0.1F * static_cast<float>(i % 50));
  return pulses;
}

AnswerBatch Sea(std::size_t size) {
  AnswerBatch sea;
  AnswerSelection selection;
  SelectForTotals(selection);
  sea.Resize(size, selection);
  for (std::size_t i = 0; i < size; ++i) {
    sea.outcomes[i] = 1;
    sea.values[Index(Quantity::kThu)][i] = 0.2F;
    sea.values[Index(Quantity::kTvu)][i] = 0.04F;
    sea.values[Index(Quantity::kRefractionAlongWind)][i] = 2;
    sea.values[Index(Quantity::kRefractionCrossWind)][i] = 1;
    sea.values[Index(Quantity::kBiasAlongBeam)][i] = sea.values[Index(Quantity::kBiasVertical)][i] = 0;
  }
  return sea;
}

TotalPlan PlanOfNumbers() {
  TotalPlan plan;
  plan.options.errors = {.position = {0.02, 0.03, 0.06},
                         .attitude = {0.005, 0.005, 0.008},
                         .lever_arm = 0.02,
                         .scan = 0.02,
                         .bottom_range = 0.025};
  plan.options.datum = 0.05;
  plan.options.extra_horizontal = 0.04;
  plan.options.extra_vertical = 0.03;
  plan.sea_axis = 70;
  plan.numbers = {{"position", "", "", false}, {"lever_arm", "", "", true}, {"scan", "", "", true}};
  return plan;
}

SourceSums Sampled(const TotalPlan& plan, std::size_t size, double without_total = 0) {
  AircraftColumns aircraft;
  aircraft[BudgetInput::kAltitude] = {400};
  aircraft[BudgetInput::kBeamAzimuth] = {10};
  AnswerBatch sea = Sea(size);
  for (std::size_t i = 0; static_cast<double>(i) < without_total * static_cast<double>(size); ++i)
    sea.values[Index(Quantity::kThu)][i] = sea.values[Index(Quantity::kTvu)][i] = NAN;
  TotalBatch totals;
  const PulseBatch pulses = Pulses(size);
  ComputeTotals(plan, pulses, sea, aircraft, totals);
  return SampleSources(plan, pulses, aircraft, totals);
}

// Two computations: the sources in double precision, one by one, and the total of the columns.
TEST(SourceSums, AddUpToTheTotal) {
  const SourceSums sums = Sampled(PlanOfNumbers(), 1000);
  EXPECT_EQ(sums.samples, kSourceSamples);
  AxisVariances all;
  for (const AxisVariances& source : sums.sources) all.Add(source);
  EXPECT_NEAR(all.horizontal / sums.total.horizontal, 1, 1e-4);
  EXPECT_NEAR(all.vertical / sums.total.vertical, 1, 1e-4);
}

TEST(SourceSums, AssumedIsThatOfTheAssumedSources) {
  const SourceSums sums = Sampled(PlanOfNumbers(), 1000);
  AxisVariances expected;
  for (const auto index : {Index(&AirErrors::lever_arm), Index(&AirErrors::scan)}) expected.Add(sums.sources[index]);
  EXPECT_GT(expected.vertical, 0);
  EXPECT_DOUBLE_EQ(sums.assumed.horizontal, expected.horizontal);
  EXPECT_DOUBLE_EQ(sums.assumed.vertical, expected.vertical);
  const auto json = sums.Json();
  EXPECT_NEAR(json["assumed"]["vertical"], expected.vertical / sums.total.vertical, 1e-12);
  // A variance of its own: 0.05^2 of each pulse.
  EXPECT_NEAR(json["sources"]["datum"]["vertical"], 1000 * 0.0025 / sums.total.vertical, 1e-9);
  EXPECT_FALSE(json["sources"].contains("water"));
}

TEST(SourceSums, CountPulsesWithATotalAlone) {
  const SourceSums all = Sampled(PlanOfNumbers(), 2000), half = Sampled(PlanOfNumbers(), 2000, 0.5);
  EXPECT_EQ(half.samples, kSourceSamples / 2);
  EXPECT_NEAR(half[OtherSource::kDatum].vertical / all[OtherSource::kDatum].vertical, 0.5, 1e-3);
  EXPECT_EQ(Sampled(PlanOfNumbers(), 10, 1).samples, 0);
}

}  // namespace
}  // namespace albtpu::annotate
