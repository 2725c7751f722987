#include "formats/clocks/time_tally.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <span>
#include <vector>

namespace albtpu::formats {
namespace {

constexpr double kBegin = 147532417;  // s

TimeTally TallyOf(int points, std::initializer_list<double> strays) {
  TimeTally tally;
  for (int i = 0; i < points; ++i) tally.Add(kBegin + 0.01 * i);
  for (const double time : strays) tally.Add(time);
  return tally;
}

TEST(TimeTally, LeavesOutFewTimesThatLieFarFromAllOthers) {
  for (const double stray : {1.0, -1e9, 5e-324, 1e9, 1e300, -1e300, kBegin + 40 * 86400, kBegin - 40 * 86400}) {
    const TimeTally tally = TallyOf(1000, {stray, 7});
    ASSERT_TRUE(tally.Bulk().has_value()) << stray;
    EXPECT_EQ(tally.Bulk()->first, kBegin);
    EXPECT_EQ(tally.Bulk()->last, kBegin + 9.99);
    EXPECT_EQ(tally.outside_of_bulk(), 2);
  }
}

TEST(TimeTally, KeepsTimesOfOneSurveyTogether) {
  EXPECT_FALSE(TallyOf(1000, {}).Bulk().has_value());
  EXPECT_FALSE(TallyOf(1000, {kBegin + 25 * 86400}).Bulk().has_value());
  EXPECT_FALSE(TimeTally().Bulk().has_value());
}

TEST(TimeTally, KeepsMoreThanOneInAHundred) {
  EXPECT_FALSE(TallyOf(100, {7, 8}).Bulk().has_value());
  TimeTally disorder = TallyOf(1000000, {});
  for (int i = 0; i < 9000; ++i) disorder.Add(86400.0 * 40 * i);
  EXPECT_FALSE(disorder.Bulk().has_value());
}

TEST(TimeTally, IsTheSameFromParts) {
  TimeTally whole = TallyOf(500, {});
  whole.Merge(TallyOf(500, {3}));
  ASSERT_TRUE(whole.Bulk().has_value());
  EXPECT_EQ(whole.Bulk()->last, kBegin + 4.99);
  EXPECT_EQ(whole.outside_of_bulk(), 1);
}

TEST(TimeTally, IsTheSameOfTimesTogether) {
  for (const double step : {1.0, 1000.0, 5e6}) {  // Over 83 minutes, 58 days, 792 years.
    std::vector<double> times;
    TimeTally one_by_one, together;
    for (int i = 0; i < 5000; ++i) one_by_one.Add(times.emplace_back(kBegin + step * (i * 7 % 5000)));
    together.Add(times);
    together.Add(std::span<const double>());
    const std::vector<TimeTally::Group> expected = one_by_one.Groups(), groups = together.Groups();
    ASSERT_EQ(groups.size(), expected.size());
    for (std::size_t i = 0; i < groups.size(); ++i) {
      EXPECT_EQ(groups[i].points, expected[i].points);
      EXPECT_EQ(groups[i].span.first, expected[i].span.first);
      EXPECT_EQ(groups[i].span.last, expected[i].span.last);
    }
  }
}

TEST(TimeTally, FindsTheStepOfRoundedTimes) {
  for (const double step : {1.0, 0.1, 0.25}) {
    TimeTally tally;
    double before = kBegin;
    for (int i = 1; i < 10000; ++i) {
      const double time = kBegin + step * std::round(i * 0.001 / step);
      tally.AddPulses(before, time);
      before = time;
    }
    ASSERT_TRUE(tally.CoarseStep().has_value());
    EXPECT_NEAR(*tally.CoarseStep(), step, 1e-6);
  }
}

TEST(TimeTally, FindsThatAllTimesAreEqual) {
  TimeTally tally;
  for (int i = 0; i < 1000; ++i) tally.AddPulses(kBegin, kBegin);
  ASSERT_TRUE(tally.CoarseStep().has_value());
  EXPECT_TRUE(std::isinf(*tally.CoarseStep()));
}

TEST(TimeTally, DoesNotDoubtTimesOfTheirOwn) {
  TimeTally tally;
  for (int i = 1; i < 1000; ++i) tally.AddPulses(kBegin + 0.001 * (i - 1), kBegin + 0.001 * i);
  EXPECT_FALSE(tally.CoarseStep().has_value());
}

}  // namespace
}  // namespace albtpu::formats
