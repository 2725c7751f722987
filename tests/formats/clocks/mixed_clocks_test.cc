#include "formats/clocks/mixed_clocks.h"

#include <gmock/gmock.h>

#include "tests/formats/clocks/written_times.h"

namespace albtpu::formats {
namespace {

using ::testing::HasSubstr;

// Wednesday 2016-05-11, 14:00:00 UTC and the 30 s after it, GPS time since 1980.
TimeTally MixedTally(int points, double first, int others, double first_of_others) {
  TimeTally tally;
  for (int i = 0; i < points; ++i) tally.Add(first + 30.0 * i / points);
  for (int i = 0; i < others; ++i) tally.Add(first_of_others + 30.0 * i / others);
  return tally;
}

TEST(MixedClocks, AreNamedWithTheirPoints) {
  const struct {
    double first, other;
    std::string text;
  } kCases[] = {
      {kOfWeek, kGpsTime - 1e9,
       "60 points have seconds of the GPS week (309617.0 to 309646.5), and 40 adjusted standard GPS"},
      {kGpsTime - 1e9, kOfWeek,
       "60 points have adjusted standard GPS times (147010417.0 to 147010446.5), and 40 seconds of"},
      {kGpsTime, kGpsTime - 1e9,
       "60 points have GPS seconds since 1980 (1147010417.0 to 1147010446.5), and 40 adjusted"},
      {kGpsTime - 1e9, 1462975200, "and 40 Unix seconds (1462975200.0 to"},
      {kGpsTime, 1462975200, "have GPS seconds since 1980"},
      {kGpsTime - 1e9, 50417, "and 40 seconds of the GPS week or of the day (50417.0 to"},
  };
  for (const auto& each : kCases) {
    const std::optional<std::string> mixed = MixedClocks(MixedTally(60, each.first, 40, each.other));
    EXPECT_THAT(mixed.value_or(""), HasSubstr(each.text));
    EXPECT_FALSE(CheckOneClock("in.las", MixedTally(60, each.first, 40, each.other)).ok());
  }
}

TEST(MixedClocks, AreNotFlightsOfOneClockAtSeveralDates) {
  for (const double days : {0.0, 1.0, 29.0, 31.0, 400.0, 3000.0})
    for (const double first : {kGpsTime - 1e9, kGpsTime, 1462975200.0}) {
      EXPECT_EQ(MixedClocks(MixedTally(60, first, 40, first + 86400 * days)), std::nullopt) << first << " " << days;
      EXPECT_TRUE(CheckOneClock("in.las", MixedTally(60, first, 40, first + 86400 * days)).ok());
    }
  EXPECT_EQ(MixedClocks(MixedTally(60, kOfWeek, 40, kOfWeek + 2 * 86400)), std::nullopt);
  EXPECT_EQ(MixedClocks(TimeTally()), std::nullopt);
}

// Those are noted, and have no trajectory.
TEST(MixedClocks, AreNotAFewStrayTimes) {
  EXPECT_EQ(MixedClocks(MixedTally(1000, kGpsTime - 1e9, 5, kOfWeek)), std::nullopt);
}

}  // namespace
}  // namespace albtpu::formats
