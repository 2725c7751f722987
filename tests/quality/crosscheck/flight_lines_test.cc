#include "quality/crosscheck/flight_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "quality/crosscheck/cross_check.h"

namespace albtpu::quality {
namespace {

using ::testing::HasSubstr;

struct Pass {
  int id;
  double begin, seconds;  // s
};

LineTimes TimesOf(const std::vector<Pass>& passes) {
  LineTimes times;
  for (const Pass& pass : passes)
    for (double time = pass.begin; time < pass.begin + pass.seconds; time += 0.1) times.Add(pass.id, time);
  return times;
}

TEST(FlightLines, AreToldApartByPausesWhereIdsAreEqual) {
  const struct {
    std::vector<Pass> passes;
    std::size_t lines;
  } cases[] = {{{{1, 100, 60}, {2, 200, 60}}, 2},                   // As the IDs say.
               {{{0, 100, 60}, {0, 220, 60}}, 2},                   // No ID is assigned.
               {{{0, 100, 60}, {0, 170, 60}}, 1},                   // Too short a pause.
               {{{7, 100, 60}, {7, 220, 60}, {7, 340, 60}}, 3},     // One ID for all.
               {{{1, 100, 60}, {1, 220, 60}, {2, 340, 60}}, 2},     // A line over land has pauses.
               {{{1, 100, 60}, {2, 220, 60}, {1, 86'500, 60}}, 3},  // IDs of another day.
               {{{0, 100, 60}, {0, 220, 60}, {5, 160, 60}}, 3},     // Some points have no ID.
               {{{0, 220, 60}, {0, 100, 60}}, 2},                   // In any order.
               {{{0, 0, 0.05}}, 1},                                 // No times.
               {{{0, -252'467'582, 6}, {0, -252'467'400, 6}}, 2},   // Before the origin of the times.
               {{{0, 100, 60}, {0, 100, 60}}, 1},                   // The same line twice.
               {{}, 0}};
  for (const auto& of : cases) {
    const FlightLines lines(TimesOf(of.passes));
    EXPECT_EQ(lines.size(), of.lines);
    // Points have numbers that rise with ID and time, and each number has its ID.
    for (const Pass& pass : of.passes) {
      if (pass.begin == 0) continue;
      const auto number = lines.NumberOf(pass.id, pass.begin + pass.seconds / 2);
      ASSERT_TRUE(number.has_value());
      EXPECT_EQ(lines.Line(*number).id, pass.id);
      EXPECT_EQ(number, lines.NumberOf(pass.id, pass.begin));
      for (const Pass& other : of.passes) {
        if (other.id != pass.id || other.begin >= pass.begin) continue;
        EXPECT_EQ(*number == *lines.NumberOf(other.id, other.begin), std::isnan(lines.Line(*number).begin));
      }
    }
  }
}

TEST(FlightLines, AreIdsWhereNoneStandsForSeveral) {
  const FlightLines lines(TimesOf({{9, 100, 60}, {300, 100, 60}}));
  EXPECT_EQ(lines.NumberOf(9, 100), 9);
  EXPECT_EQ(lines.NumberOf(300, NAN), 300);
  EXPECT_EQ(NameOf(lines.Line(300)), "line 300");
}

TEST(FlightLines, LeaveOutPointsWithoutATimeWhereTheIdDoesNotSuffice) {
  LineTimes times = TimesOf({{0, 100, 60}, {0, 220, 60}});
  times.Add(0, 0);
  times.Add(0, NAN);
  const FlightLines lines(times);
  EXPECT_EQ(lines.size(), 2u);
  EXPECT_FALSE(lines.NumberOf(0, 0).has_value());
  EXPECT_FALSE(lines.NumberOf(0, INFINITY).has_value());
  EXPECT_EQ(NameOf(lines.Line(*lines.NumberOf(0, 250))), "line 0 from 220 s on");
}

TEST(FlightLines, SayWhyThereIsNothingToCompare) {
  EXPECT_THAT(FlightLines(TimesOf({{0, 100, 6}})).NothingToCompare(), HasSubstr("cannot be told apart"));
  EXPECT_THAT(FlightLines(TimesOf({{0, 100, 6}})).NothingToCompare(), HasSubstr("point source ID 0"));
  EXPECT_THAT(FlightLines(TimesOf({{1, 100, 6}, {2, 200, 6}})).NothingToCompare(), HasSubstr("no lines overlap ("));
}

// Two passes over one bottom, the second 0.1 m higher: patches find the difference whatever the IDs are.
TEST(FlightLines, AreComparedInPatches) {
  const struct {
    int first, second;
    double pause;
    bool compared;
  } cases[] = {{1, 2, 60, true}, {0, 0, 60, true},   {5, 5, 60, true},
               {0, 0, 5, false}, {0, 0, -20, false}, {1, 2, -20, true}};
  for (const auto& of : cases) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 100);
    std::normal_distribution<double> noise(0, 0.05);
    std::vector<AnnotatedPoint> points;
    for (int i = 0; i < 8000; ++i) {
      const bool second = i % 2 == 1;
      AnnotatedPoint point;
      point.x = uniform(random), point.y = uniform(random) / 5;
      point.z = -10 + noise(random) + (second ? 0.1 : 0);
      point.time = 1000 + point.x / 5 + (second ? 20 + of.pause : 0);
      point.line = second ? of.second : of.first;
      point.has_number = true;
      point.tvu = point.tvu_pulse = 0.05F;
      point.variance_x = point.variance_y = point.variance_z = 0.0025F;
      point.depth = 10;
      points.push_back(point);
    }
    OverlapPatches patches(5, 1, Coverage::kOneSigma);
    patches.Find(points);
    patches.Choose();
    patches.Fill(points, PulseOnWater::kNoSea);
    const std::optional<CrossCheck> check = CheckPatches(patches, SharedWaves());
    ASSERT_EQ(check.has_value(), of.compared) << of.first << " " << of.second << " " << of.pause;
    if (!check.has_value()) continue;
    ASSERT_EQ(check->line.differences.size(), 1u);
    EXPECT_EQ(check->line.differences[0].line_a, of.first);
    EXPECT_EQ(check->line.differences[0].line_b, of.second);
    // A mean of 80 pairs or so, of a difference of 0.07 m each.
    EXPECT_NEAR(check->line.differences[0].mean, -0.1, 4 * 0.071 / std::sqrt(static_cast<double>(check->pairs)));
    EXPECT_EQ(std::isnan(check->line.differences[0].begin_a), of.first != of.second);
  }
}

}  // namespace
}  // namespace albtpu::quality
