#include "annotate/answers/answer_counts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "service/client/local_source.h"
#include "tables/query/interpolation.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu::annotate {
namespace {

using albtpu::testing::SyntheticTable;

// Pulses around the table's corners: each axis below, at and above its first and last node, and not finite.
PulseBatch PulsesAroundTheTable(const UncertaintyTable& table) {
  PulseBatch pulses{.size = 0, .axis = {}};
  const std::array<float, kAxisCount> inside = {5, 3e4f, 12, 30, 0.6f, 7};
  for (const AxisId varied : kAxes) {
    const std::vector<double>& nodes = table.axes()[Index(varied)].nodes();
    const auto first = static_cast<float>(nodes.front()), last = static_cast<float>(nodes.back());
    for (const float number : {std::nextafter(first, -INFINITY), first, std::nextafter(last, 0.0f), last,
                               std::nextafter(last, INFINITY), -1e30f, 1e30f, NAN, INFINITY, -INFINITY}) {
      ++pulses.size;
      for (const AxisId axis : kAxes) pulses[axis].push_back(axis == varied ? number : inside[Index(axis)]);
    }
  }
  return pulses;
}

TEST(OutcomeName, IsThatOfTheInterpolationInDoublePrecision) {
  const UncertaintyTable table = SyntheticTable();
  client::LocalSource source("", table);
  const PulseBatch pulses = PulsesAroundTheTable(table);
  AnswerBatch answers;
  ASSERT_TRUE(AnswerPulses(source, {}, pulses, {}, answers).ok());
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < pulses.size; ++i) {
    const auto at = [&](AxisId axis) { return pulses.coordinate(axis, i); };
    const Pulse pulse = {.wind_speed = at(AxisId::kWindSpeed),
                         .fetch = at(AxisId::kFetch),
                         .incidence = at(AxisId::kIncidence),
                         .azimuth = at(AxisId::kAzimuth),
                         .footprint = at(AxisId::kFootprint),
                         .depth = at(AxisId::kDepth)};
    EXPECT_EQ(OutcomeName(answers, i), OutcomeText(Interpolate(table, pulse))) << i;
    names.insert(OutcomeName(answers, i));
  }
  // Of five axes both sides, but of an endless fetch one; no side of the azimuth, which is folded into its nodes.
  EXPECT_EQ(names.size(), 4 * 2 + 1 + 2u);
}

TEST(OutcomeName, HasNoSideOnTheAzimuth) {
  TableAxes ranges = {};
  ranges[Index(AxisId::kAzimuth)] = {.first = 0, .last = 45, .nodes = 2};
  PulseBatch pulses{.size = 1, .axis = {}};
  pulses[AxisId::kAzimuth] = {60};
  AnswerBatch answers;
  answers.Resize(1, {});
  answers.outcomes[0] = 2;
  answers.outcome_axes[0] = Index(AxisId::kAzimuth) + 1;
  answers.FindSides(pulses, ranges);
  EXPECT_EQ(OutcomeName(answers, 0), "OUT_OF_DOMAIN:azimuth");
}

TEST(OutcomeCounts, CountsPointsWithAndWithoutAPulse) {
  AnswerBatch answers;
  answers.Resize(3, {});
  answers.outcomes = {1, 2, 3};
  answers.outcome_axes = {0, 6, 6};
  answers.sides = {0, 2, 0};
  OutcomeCounts counts, more;
  counts.Add(answers, true);
  counts.Add(NoPulse::kAboveWater, 2);
  more.Add(NoPulse::kNoTrajectory);
  more.Add(NoPulse::kUncertainTrajectory);
  more.Add(NoPulse::kNoSurface);
  counts.Merge(more);
  EXPECT_EQ(counts.total(), 8u);
  EXPECT_EQ(counts.interpolated(), 1u);
  EXPECT_EQ(counts.Json().dump(), R"({"INTERPOLATED":1,"OUT_OF_DOMAIN:depth:above":1,"INVALID":1,"NO_TRAJECTORY":1,)"
                                  R"("UNCERTAIN_TRAJECTORY":1,"NO_SURFACE":1,"ABOVE_WATER":2})");
  EXPECT_EQ(counts.Text(),
            "8 pulses: 1 interpolated, 1 OUT_OF_DOMAIN:depth:above, 1 INVALID, 1 NO_TRAJECTORY, "
            "1 UNCERTAIN_TRAJECTORY, 1 NO_SURFACE, 2 ABOVE_WATER; all without azimuth: each value is the "
            "larger of those along and across the wind");
  client::TableSummary of_one_sea;
  of_one_sea.sea.emplace();
  EXPECT_TRUE(counts.Text(WithoutAzimuth(of_one_sea))
                  .ends_with("; all without azimuth: each value is the largest of all azimuths"));
}

}  // namespace
}  // namespace albtpu::annotate
