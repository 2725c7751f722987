#include "formats/clocks/dated_clock.h"

#include <gmock/gmock.h>

#include "sea/sea_time.h"
#include "tests/formats/clocks/written_times.h"

namespace albtpu::formats {
namespace {

using ::testing::HasSubstr;

const Written kDated[] = {
    {TimeFormat::kWeek, PointTimeForm::kAdjustedStandard, kOfWeek, 1, "seconds of the GPS week"},
    {TimeFormat::kAdjusted, PointTimeForm::kWeekSeconds, kGpsTime - 1e9, 1, "adjusted standard GPS times"},
    {TimeFormat::kGps, PointTimeForm::kWeekSeconds, kGpsTime, 1, "GPS seconds since 1980"},
    {TimeFormat::kUnix, PointTimeForm::kAdjustedStandard, kUnix, 1, "Unix seconds"},
    {TimeFormat::kDay, PointTimeForm::kWeekSeconds, kOfDay, 1, "seconds of the day, a Wednesday"},
    {TimeFormat::kMilliseconds, PointTimeForm::kWeekSeconds, 1e3 * kOfWeek, 1e3, "milliseconds of the GPS week"},
    {TimeFormat::kMilliseconds, PointTimeForm::kAdjustedStandard, 1e3 * kUnix, 1e3, "Unix milliseconds"},
};

PointTimes DatedTimes(const Written& written) {
  return {{written.first, written.first + 1800 * written.unit}, written.header};
}

PointTimes HalfHourOfWeek(double first, std::optional<double> created = std::nullopt) {
  return {{first, first + 1800}, PointTimeForm::kWeekSeconds, created};
}

absl::StatusOr<UtcClock> Find(const PointTimes& points, const TimeSpan& known, std::string& note,
                              TimeFormat format = TimeFormat::kAuto) {
  return FindUtcClock("in.las", points, {.format = format}, known, "sea.csv", note);
}

std::string ErrorOfClock(const PointTimes& points, const TimeSpan& known) {
  std::string note;
  const absl::StatusOr<UtcClock> clock = Find(points, known, note);
  EXPECT_FALSE(clock.ok());
  return std::string(clock.status().message());
}

TEST(DatedClock, IsFoundByTheTimesOfASea) {
  const TimeSpan known = Span("2016-05-11T12:00Z", "2016-05-11T18:00Z");
  for (const Written& written : kDated) {
    const PointTimes stated = DatedTimes(written);
    std::string note;
    for (const TimeFormat format : {TimeFormat::kAuto, written.format}) {
      const absl::StatusOr<UtcClock> clock = Find(stated, known, note, format);
      ASSERT_TRUE(clock.ok()) << written.description << ": " << clock.status();
      EXPECT_NEAR((*clock)(stated.span.first), kUnix, 1e-6) << written.description;
      EXPECT_NEAR((*clock)(stated.span.last), kUnix + 1800, 1e-6) << written.description;
      if (format == TimeFormat::kAuto)
        EXPECT_THAT(note, ::testing::AllOf(HasSubstr(std::string("are ") + written.description), HasSubstr("sea.csv"),
                                           HasSubstr(TimeFormatFlag({.format = written.format, .description = ""}))));
      else
        EXPECT_EQ(note, "");
    }
  }
}

TEST(DatedClock, IsThatOfTheHeaderWhereItFits) {
  std::string note = "none";
  const TimeSpan known = Span("2016-05-11T12:00Z", "2016-05-11T18:00Z");
  EXPECT_TRUE(Find(HalfHourOfWeek(kOfWeek), known, note).ok());
  EXPECT_EQ(note, "");
}

TEST(DatedClock, IsNoneWhereTheUserNamesAnother) {
  std::string note;
  const TimeSpan known = Span("2016-05-11T12:00Z", "2016-05-11T18:00Z");
  EXPECT_THAT(std::string(Find(HalfHourOfWeek(kOfWeek), known, note, TimeFormat::kUnix).status().message()),
              HasSubstr("outside of sea.csv if --time-format unix is right"));
}

TEST(DatedClock, IsNotGuessedWhereSeveralDaysFit) {
  const TimeSpan known = Span("2016-05-09T00:00Z", "2016-05-14T00:00Z");
  const std::string error = ErrorOfClock(HalfHourOfWeek(kOfDay), known);
  EXPECT_THAT(error, HasSubstr("seconds of the day, a Tuesday (2016-05-10) or as seconds of the day, a Wednesday "));
}

TEST(DatedClock, IsThatOfTheCreationOfTheFile) {
  const TimeSpan month = Span("2016-05-01T00:00Z", "2016-05-31T00:00Z");
  std::string note;
  // 2016-05-11 is the day 132 of a leap year. Export on the day of the flight, or before the next flight.
  for (const int day : {132, 137}) {
    const absl::StatusOr<UtcClock> clock =
        Find(HalfHourOfWeek(kOfWeek, GpsTimeOfDay(2016, day)), {month.first + 6 * 86400, month.last}, note);
    ASSERT_TRUE(clock.ok()) << clock.status();
    EXPECT_EQ((*clock)(kOfWeek), kUnix);
    EXPECT_THAT(note, ::testing::AllOf(HasSubstr("2016-05-11 is taken because of the creation of the file on 2016-05-"),
                                       ::testing::Not(HasSubstr("as their file states"))));
  }
  // Seconds of a day of several.
  const TimeSpan days = Span("2016-05-09T00:00Z", "2016-05-14T00:00Z");
  const absl::StatusOr<UtcClock> clock = Find(HalfHourOfWeek(kOfDay, GpsTimeOfDay(2016, 132)), days, note);
  ASSERT_TRUE(clock.ok()) << clock.status();
  EXPECT_EQ((*clock)(kOfDay), kUnix);
  EXPECT_THAT(note, HasSubstr("--time-format day says so; of the dates"));
}

TEST(DatedClock, IsNotThatOfACreationThatDecidesNothing) {
  const TimeSpan month = Span("2016-05-01T00:00Z", "2016-05-31T00:00Z");
  // Export a year later, before all of them, on no day at all.
  for (const auto& created : {GpsTimeOfDay(2017, 200), GpsTimeOfDay(2001, 1), GpsTimeOfDay(2016, 0)})
    EXPECT_THAT(ErrorOfClock(HalfHourOfWeek(kOfWeek, created), month), HasSubstr("2016-05-18"));
  // Where the clock of the header fits, its creation changes nothing.
  std::string note;
  const TimeSpan known = Span("2016-05-11T12:00Z", "2016-05-11T18:00Z");
  EXPECT_TRUE(Find(HalfHourOfWeek(kOfWeek, GpsTimeOfDay(2001, 1)), known, note).ok());
  EXPECT_EQ(note, "");
}

// Adjusted standard times of 2016-05-11, written on that day, and the milliseconds of a Sunday that they might be.
TEST(DatedClock, IsThatOfAPlausibleHeader) {
  PointTimes points = {
      {kGpsTime - 1e9, kGpsTime - 1e9 + 1800}, PointTimeForm::kAdjustedStandard, GpsTimeOfDay(2016, 132)};
  const TimeSpan sunday = Span("2016-05-15T00:00Z", "2016-05-17T23:00Z");
  EXPECT_THAT(ErrorOfClock(points, sunday), HasSubstr("measured outside of sea.csv"));
  points.created.reset();
  std::string note;
  EXPECT_TRUE(Find(points, sunday, note).ok());
  EXPECT_THAT(note, HasSubstr("are milliseconds of the "));
  points.count = 100000;  // In 1.8 s: 56 kHz.
  EXPECT_TRUE(Find(points, sunday, note).ok());
  points.count = 100000000;  // 56 MHz
  EXPECT_THAT(ErrorOfClock(points, sunday), HasSubstr("measured outside of sea.csv"));
}

TEST(DatedClock, IsOfADayOnlyWithinIt) {
  // Monday, 10:00, and the same hour of Tuesday.
  EXPECT_THAT(ErrorOfClock(HalfHourOfWeek(122400), Span("2016-05-10T09:00Z", "2016-05-10T12:00Z")),
              HasSubstr("measured outside of sea.csv"));
}

TEST(DatedClock, IsNotInMillisecondsOfWhatMayBeSecondsOfTheWeek) {
  // Half an hour of Wednesday afternoon, of which a thousandth is 6 minutes after any midnight.
  PointTimes points = HalfHourOfWeek(kOfWeek);
  for (const PointTimeForm form : {PointTimeForm::kWeekSeconds, PointTimeForm::kAdjustedStandard}) {
    points.form = form;
    EXPECT_THAT(ErrorOfClock(points, Span("2016-05-10T23:00Z", "2016-05-11T02:00Z")),
                HasSubstr("measured outside of sea.csv"));
  }
}

// A flight over midnight in UTC, of which only a part has the day of the first point.
TEST(DatedClock, IsNoneWhereSecondsOfTheDayBeginAgain) {
  const PointTimes points = {{5, 86395}, PointTimeForm::kWeekSeconds, GpsTimeOfDay(2016, 132)};
  std::string note;
  for (const TimeFormat format : {TimeFormat::kDay, TimeFormat::kUtcDay}) {
    const absl::StatusOr<UtcClock> clock = Find(points, Span("2016-05-11T00:00Z", "2016-05-13T00:00Z"), note, format);
    EXPECT_THAT(std::string(clock.status().message()), HasSubstr("as if they began again at midnight"));
  }
}

TEST(DatedClock, IsOfADayOfSeveralFlights) {
  const PointTimes points = {{7 * 3600, 20 * 3600}, PointTimeForm::kWeekSeconds, GpsTimeOfDay(2016, 132)};
  std::string note;
  const absl::StatusOr<UtcClock> clock =
      Find(points, Span("2016-05-11T00:00Z", "2016-05-12T00:00Z"), note, TimeFormat::kDay);
  ASSERT_TRUE(clock.ok()) << clock.status();
  EXPECT_NEAR((*clock)(points.span.first), kUnix - 7 * 3600 - 17, 1e-6);
}

TEST(DatedClock, OfAMondayInMillisecondsIsNotOfADay) {
  const PointTimes points = {{1e3 * 130000, 1e3 * 131800}, PointTimeForm::kWeekSeconds};
  std::string note;
  EXPECT_TRUE(Find(points, Span("2016-05-09T00:00Z", "2016-05-11T00:00Z"), note, TimeFormat::kMilliseconds).ok());
}

TEST(DatedClock, IsOfADayThatContinuesOnlyWhereTheUserNamesIt) {
  // 10:00 of the day after.
  const PointTimes points = HalfHourOfWeek(122400, GpsTimeOfDay(2016, 132));
  const TimeSpan known = Span("2016-05-12T09:00Z", "2016-05-12T12:00Z");
  std::string note;
  EXPECT_FALSE(Find(points, known, note).ok());
  const absl::StatusOr<UtcClock> clock = Find(points, known, note, TimeFormat::kDay);
  ASSERT_TRUE(clock.ok()) << clock.status();
  EXPECT_NEAR((*clock)(122400), kUnix + 20 * 3600 - 17, 1e-6);
}

TEST(ClockReading, AgreesWithThoseOfOtherSources) {
  const PointTimes points = HalfHourOfWeek(kOfDay, GpsTimeOfDay(2016, 132));
  const double wednesday = 1896 * kSecondsPerWeek + 3 * 86400 - kAdjustedGpsOffset;
  const ClockReading levels = {.of = "levels.csv", .shift = wednesday};
  const ClockReading track = {.of = "the trajectory", .shift = 3 * 86400 + 18, .form = PointTimeForm::kWeekSeconds};
  const auto check = [&](const ClockReading& a, const ClockReading& b) {
    return CheckReadingsAgree("in.las", points, std::vector{a, b});
  };
  EXPECT_TRUE(check(levels, track).ok());
  EXPECT_TRUE(check(track, levels).ok());
  EXPECT_TRUE(check(levels, levels).ok());
  EXPECT_EQ(CreationNote(points, std::vector{track, levels}), "");
  const ClockReading thursday = {.of = "sea.csv", .shift = wednesday + 86400};
  EXPECT_THAT(std::string(check(track, thursday).message()),
              ::testing::AllOf(HasSubstr("in.las: its first point is at "),
                               HasSubstr(" of a Wednesday by the trajectory, but at 2016-05-12T"),
                               HasSubstr(" by sea.csv; give both of the day of the flight")));
  // Of another week: only a source that names its week contradicts it.
  const ClockReading later = {.of = "later.csv", .shift = wednesday + 52 * kSecondsPerWeek};
  EXPECT_TRUE(check(track, later).ok());
  EXPECT_FALSE(check(levels, later).ok());
  EXPECT_THAT(CreationNote(points, std::vector{track, later}),
              ::testing::AllOf(HasSubstr("measured at 2017-05-10T"),
                               HasSubstr("by later.csv, after their file was created on 2016-05-11 by its header")));
  // Points of two weeks have two beginnings.
  EXPECT_TRUE(
      CheckReadingsAgree("in.las", {{0, kSecondsPerWeek - 1}, PointTimeForm::kWeekSeconds}, std::vector{levels, later})
          .ok());
}

TEST(DatedClock, DoesNotBeginAgain) {
  const TimeSpan month = Span("2016-05-01T00:00Z", "2016-05-31T00:00Z");
  EXPECT_THAT(ErrorOfClock({{5, 604790}, PointTimeForm::kWeekSeconds, GpsTimeOfDay(2016, 132)}, month),
              HasSubstr("seconds of a week that they do not name"));
}

TEST(GpsTimeOfDay, IsTheBeginningOfADayOfItsYear) {
  EXPECT_EQ(UtcText(GpsTimeOfDay(2016, 132).value()), "2016-05-11T00:00:00Z");
  EXPECT_EQ(UtcText(GpsTimeOfDay(2016, 366).value()), "2016-12-31T00:00:00Z");
  for (const auto& [year, day] : {std::pair(2015, 366), {2016, 0}, {0, 1}, {1980, 10}, {60000, 1}})
    EXPECT_FALSE(GpsTimeOfDay(year, day).has_value()) << year << " " << day;
}

}  // namespace
}  // namespace albtpu::formats
