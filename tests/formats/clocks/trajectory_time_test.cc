#include "formats/clocks/trajectory_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace albtpu::formats {
namespace {

using ::testing::HasSubstr;

constexpr double kWeek = 604800;
// GPS week 1896 begins on 8 May 2016; the Florida sample was flown in it.
constexpr double kBeginOfWeek1896 = 1896 * kWeek - 1e9;

PointTimes Adjusted(double first, double last) { return {{first, last}, PointTimeForm::kAdjustedStandard}; }
PointTimes WeekSeconds(double first, double last) { return {{first, last}, PointTimeForm::kWeekSeconds}; }
double Offset(TimeSpan trajectory, const PointTimes& points, TrajectoryClock clock = TrajectoryClock::kGps) {
  const absl::StatusOr<double> offset = TimeOffset("flight.sbet", trajectory, clock, points);
  EXPECT_TRUE(offset.ok()) << offset.status();
  return offset.value_or(-1);
}
std::string Refusal(TimeSpan trajectory, const PointTimes& points, TrajectoryClock clock = TrajectoryClock::kGps) {
  return std::string(TimeOffset("flight.sbet", trajectory, clock, points).status().message());
}

TEST(TrajectoryTime, OverlapIsNegativeBetweenIntervalsApart) {
  EXPECT_EQ(Overlap({0, 10}, {5, 20}), 5);
  EXPECT_EQ(Overlap({5, 20}, {0, 10}), 5);
  EXPECT_EQ(Overlap({0, 1}, {3, 4}), -2);
}

TEST(TrajectoryTime, FindsTheWeekOfAdjustedTimes) {
  EXPECT_EQ(Offset({300000, 310000}, Adjusted(kBeginOfWeek1896 + 305000, kBeginOfWeek1896 + 305100)), kBeginOfWeek1896);
}

TEST(TrajectoryTime, TakesWeekSecondsAsTheyAre) { EXPECT_EQ(Offset({300000, 310000}, WeekSeconds(305000, 305100)), 0); }

TEST(TrajectoryTime, FollowsAFlightAcrossTheEndOfTheWeek) {
  const TimeSpan flight = {604000, 605500};
  // Points before, on both sides, and after.
  EXPECT_EQ(Offset(flight, Adjusted(kBeginOfWeek1896 + 604100, kBeginOfWeek1896 + 604200)), kBeginOfWeek1896);
  EXPECT_EQ(Offset(flight, Adjusted(kBeginOfWeek1896 + 604700, kBeginOfWeek1896 + 604900)), kBeginOfWeek1896);
  EXPECT_EQ(Offset(flight, Adjusted(kBeginOfWeek1896 + 604900, kBeginOfWeek1896 + 605000)), kBeginOfWeek1896);
  EXPECT_EQ(Offset(flight, WeekSeconds(100, 200)), -kWeek);
  EXPECT_EQ(Offset(flight, WeekSeconds(0, 604799)), 0);
}

TEST(TrajectoryTime, AddsLeapSecondsOfTheDate) {
  const auto in_utc = [](double week) {
    const double begin = week * kWeek - 1e9;
    return Offset({300000, 310000}, Adjusted(begin + 305000, begin + 305100), TrajectoryClock::kUtc) - begin;
  };
  EXPECT_EQ(in_utc(1800), 16);  // July 2014
  EXPECT_EQ(in_utc(1896), 17);  // May 2016
  EXPECT_EQ(in_utc(2100), 18);  // April 2020
}

TEST(TrajectoryTime, AddsLeapSecondsOfTheCreationWhereNoDateIsKnown) {
  const auto created_at = [](std::optional<double> created) {
    PointTimes points = WeekSeconds(305000, 305100);
    points.created = created;
    return Offset({300000, 310000}, points, TrajectoryClock::kUtc);
  };
  EXPECT_EQ(created_at(GpsTimeOfDay(2014, 200)), 16);
  EXPECT_EQ(created_at(GpsTimeOfDay(2016, 132)), 17);
  EXPECT_EQ(created_at(GpsTimeOfDay(2016, 366)), 17);
  EXPECT_EQ(created_at(GpsTimeOfDay(2017, 1)), 18);
  EXPECT_EQ(created_at(std::nullopt), 18);
}

TEST(TrajectoryTime, AcceptsAbsoluteTimes) {
  const double first = kBeginOfWeek1896 + 305000;
  EXPECT_EQ(Offset({first - 100, first + 100}, Adjusted(first, first + 1)), 0);
  EXPECT_EQ(Offset({first + 1e9 - 100, first + 1e9 + 100}, Adjusted(first, first + 1)), -1e9);
  EXPECT_EQ(Offset({first - 100, first + 100}, WeekSeconds(305000, 305001)), -kBeginOfWeek1896);
  EXPECT_EQ(Offset({first + 1e9 - 100, first + 1e9 + 100}, WeekSeconds(305000, 305001)), -1896 * kWeek);
  EXPECT_EQ(Offset({first - 100, first + 100}, WeekSeconds(305000, 305001), TrajectoryClock::kUtc),
            17 - kBeginOfWeek1896);
  // October 2008: since 1980 below 1e9, as adjusted times of 2040 are.
  EXPECT_EQ(Offset({1500 * kWeek + 300000, 1500 * kWeek + 310000}, WeekSeconds(305000, 305001)), -1500 * kWeek);
  // Adjusted times of 2023 are not read so: another day would fit.
  const double other_day = 2250 * kWeek - 1e9 + 305000 + 265600;
  EXPECT_FALSE(Refusal({other_day - 100, other_day + 100}, WeekSeconds(305000, 305001)).empty());
}

TEST(TrajectoryTime, NamesBothRangesAndAnotherFlight) {
  EXPECT_THAT(
      Refusal({300000, 310000}, Adjusted(kBeginOfWeek1896 + 405000, kBeginOfWeek1896 + 405100)),
      ::testing::AllOf(HasSubstr("300000.0 to 310000.0 s"),
                       HasSubstr("405000.0 to 405100.0 s of GPS week 1896 (2016-05-12)"), HasSubstr("another flight")));
}

TEST(TrajectoryTime, NamesAnotherWeek) {
  const double first = kBeginOfWeek1896 + 305000;
  EXPECT_THAT(Refusal({first + kWeek, first + kWeek + 100}, Adjusted(first, first + 50)),
              HasSubstr("another week: it is 1 week later"));
  EXPECT_THAT(Refusal({first - 3 * kWeek, first - 3 * kWeek + 100}, Adjusted(first, first + 50)),
              HasSubstr("another week: it is 3 weeks earlier"));
  // Seconds of a week, counted on for a week and half.
  EXPECT_THAT(Refusal({305000 + kWeek, 306000 + kWeek}, Adjusted(first, first + 50)),
              HasSubstr("another week: it is 1 week later"));
  EXPECT_THAT(Refusal({305000 + kWeek, 306000 + kWeek}, WeekSeconds(305000, 305100)),
              HasSubstr("another week: it is 1 week later"));
}

TEST(TrajectoryTime, RefusesToGuessAWeek) {
  const double first = kBeginOfWeek1896 + 305000;
  EXPECT_THAT(Refusal({300000, 310000}, Adjusted(first, first + 9 * 86400)), HasSubstr("more than one week"));
  EXPECT_THAT(Refusal({300000, 310000}, Adjusted(first, first + 90 * 86400)), HasSubstr("which last 90.0 days"));
  EXPECT_EQ(Offset({200000, 210000}, Adjusted(first, first + 6 * 86400)), kBeginOfWeek1896 + kWeek);
}

TEST(TrajectoryTime, NamesPointsWithoutTimes) {
  EXPECT_THAT(Refusal({0, 310000}, WeekSeconds(0, 0)), HasSubstr("the points are all 0"));
  EXPECT_THAT(Refusal({300000, 310000}, Adjusted(0, 0)), HasSubstr("the points are all 0"));
}

TEST(TrajectoryTime, NamesTheWrongFormOfPointTimes) {
  EXPECT_THAT(Refusal({300000, 310000}, WeekSeconds(kBeginOfWeek1896 + 305000, kBeginOfWeek1896 + 305100)),
              HasSubstr("set bit 0 of its global encoding"));
  EXPECT_THAT(Refusal({300000, 310000}, Adjusted(305000, 305100)), HasSubstr("clear bit 0 of its global encoding"));
}

TEST(TrajectoryTime, NamesTheOtherClockWhereItFits) {
  const double begin = kBeginOfWeek1896 + 305000;
  EXPECT_THAT(Refusal({305000 - 18, 305010 - 18}, Adjusted(begin, begin + 10)),
              HasSubstr("(its times fit as UTC); give --trajectory-time utc"));
  EXPECT_THAT(Refusal({305000, 305010}, Adjusted(begin, begin + 10), TrajectoryClock::kUtc),
              HasSubstr("(its times fit as GPS time); give --trajectory-time gps"));
}

TEST(TrajectoryTime, NamesTheClockThatTrajectoriesDoNotHave) {
  const double begin = kBeginOfWeek1896 + 305000, gps = begin + 1e9;
  const PointTimes points = Adjusted(begin, begin + 10);
  constexpr double kUnix = 315964800 - 18;
  EXPECT_THAT(Refusal({gps + kUnix - 20, gps + kUnix + 20}, points), HasSubstr("or its times are Unix seconds"));
  EXPECT_THAT(Refusal({304990e3, 305020e3}, points), HasSubstr("or its times are milliseconds)"));
  EXPECT_THAT(Refusal({305000 - 3 * 86400 - 20, 305000 - 3 * 86400 + 20}, points),
              HasSubstr("or its times are seconds of the day"));
}

TEST(TrajectoryTime, ClaimsNoClockOfPointsThatDoesNotFit) {
  EXPECT_THAT(Refusal({305000, 305100}, {{305000e6, 305010e6}, PointTimeForm::kWeekSeconds}),
              HasSubstr("of another clock, and of none by which the trajectory is there"));
}

// The next week of a time that no clock gives is the same number.
TEST(TrajectoryTime, EndsWithTimesThatNoClockGives) {
  for (const double time : {1e17, 1e300})
    EXPECT_FALSE(Refusal({305000, 305010}, Adjusted(-time, time)).empty()) << time;
}

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
