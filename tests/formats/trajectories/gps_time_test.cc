#include <gtest/gtest.h>

#include <cmath>

#include "formats/trajectories/trajectory_time.h"

namespace albtpu::formats {
namespace {

TEST(GpsTime, IsAheadOfUtcByTheLeapSeconds) {
  EXPECT_EQ(LeapSecondsAtUtc(0), 0);
  EXPECT_EQ(*ParseUtc("2017-01-01T00:00:00Z") - *ParseUtc("2016-12-31T23:59:59Z"), 2);
  EXPECT_EQ(*ParseUtc("2014-01-01T00:00:00Z") - *ParseUtc("2013-12-31T23:59:59Z"), 1);
}

// Every 11 hours and some seconds until 2040: both directions, by the calendar of the standard library.
TEST(GpsTime, AndItsTextAreTheSameInstant) {
  for (double time = 0; time < 60 * 365.25 * 86400; time += 40001)
    ASSERT_EQ(ParseUtc(UtcText(time)), time) << UtcText(time);
}

TEST(GpsTime, WritesALeapSecondAsTheSecondAfterIt) {
  const double after = *ParseUtc("2017-01-01T00:00:00Z");
  EXPECT_EQ(UtcText(after - 2), "2016-12-31T23:59:59Z");
  EXPECT_EQ(UtcText(after - 1), "2017-01-01T00:00:00Z");
  EXPECT_EQ(UtcText(after), "2017-01-01T00:00:00Z");
  EXPECT_EQ(UtcText(after + 1.9), "2017-01-01T00:00:01Z");
}

TEST(GpsTime, StartsAgainAtTheEndOfTheWeekAlone) {
  EXPECT_TRUE(StartsNextWeek(604799.995, 0));
  EXPECT_TRUE(StartsNextWeek(604000, 100));
  EXPECT_FALSE(StartsNextWeek(604799, 604800));
  EXPECT_FALSE(StartsNextWeek(313200, 313199));
  EXPECT_FALSE(StartsNextWeek(604000, 4000));
  EXPECT_FALSE(StartsNextWeek(604799, -1));
  EXPECT_FALSE(StartsNextWeek(NAN, 0));
}

}  // namespace
}  // namespace albtpu::formats
