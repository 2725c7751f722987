#include "formats/clocks/point_clock.h"

#include <gmock/gmock.h>

#include <cmath>

#include "formats/clocks/dated_clock.h"
#include "sea/sea_time.h"
#include "tests/formats/clocks/written_times.h"

namespace albtpu::formats {
namespace {

using ::testing::HasSubstr;

double Gps(const char* text) { return ParseUtc(text).value(); }

PointTimes StandardTimes(const char* first, const char* last) {
  return {{Gps(first) - kAdjustedGpsOffset, Gps(last) - kAdjustedGpsOffset}, PointTimeForm::kAdjustedStandard};
}

PointTimes OfWeek(double first, double last) { return {{first, last}, PointTimeForm::kWeekSeconds}; }

std::string ErrorOf(const PointTimes& points, const TimeSpan& known) {
  const absl::StatusOr<double> offset = UtcOffset("in.las", points, known, "sea.csv");
  EXPECT_FALSE(offset.ok());
  EXPECT_THAT(std::string(offset.status().message()), ::testing::StartsWith("in.las: "));
  return std::string(offset.status().message());
}

TEST(UtcOfPoints, TakesLeapSecondsAwayFromStandardTimes) {
  const TimeSpan known = Span("2016-01-01T00:00Z", "2021-01-01T00:00Z");
  for (const char* text : {"2016-05-11T14:00:00Z", "2020-06-08T03:50:00Z"}) {
    const PointTimes points = StandardTimes(text, text);
    EXPECT_EQ(UtcOffset("in.las", points, known, "sea.csv").value() + points.span.first, Utc(text)) << text;
  }
}

TEST(UtcOfPoints, FindsTheWeekThatSecondsOfTheWeekLeaveOpen) {
  // 2020-06-08 is a Monday; the week began on the 7th. UTC is 18 s behind GPS.
  const double offset =
      UtcOffset("in.las", OfWeek(86418, 90018), Span("2020-06-07T12:00Z", "2020-06-09T12:00Z"), "sea.csv").value();
  EXPECT_EQ(offset + 86418, Utc("2020-06-08T00:00:00Z"));
  // A series from one week into the next that has the points of only one.
  EXPECT_EQ(
      UtcOffset("in.las", OfWeek(86418, 90018), Span("2020-06-03T00:00Z", "2020-06-09T12:00Z"), "sea.csv").value(),
      offset);
}

TEST(UtcOfPoints, AreNotGuessed) {
  EXPECT_THAT(ErrorOf(OfWeek(86418, 90018), Span("2020-06-01T00:00Z", "2020-06-30T00:00Z")),
              HasSubstr("the sea has more than one week of them"));
  EXPECT_THAT(ErrorOf(OfWeek(10, 604790), Span("2020-06-07T12:00Z", "2020-06-09T12:00Z")),
              HasSubstr("they begin again from 0"));
  EXPECT_THAT(ErrorOf(OfWeek(0, 0), Span("2020-06-07T12:00Z", "2020-06-09T12:00Z")), HasSubstr("are no times"));
}

TEST(UtcOfPoints, LieOutsideOfWhatIsKnown) {
  const TimeSpan known = Span("2020-06-07T12:00Z", "2020-06-09T12:00Z");
  EXPECT_THAT(ErrorOf(OfWeek(400000, 410000), known), HasSubstr("measured outside of sea.csv"));
  EXPECT_THAT(ErrorOf(StandardTimes("2020-06-10T00:00:00Z", "2020-06-10T02:00:00Z"), known),
              HasSubstr("the file 2020-06-07T12:00:00Z to 2020-06-09T12:00:00Z"));
}

const Written kWritten[] = {
    {TimeFormat::kWeek, PointTimeForm::kAdjustedStandard, kOfWeek, 1, "seconds of the GPS week"},
    {TimeFormat::kAdjusted, PointTimeForm::kWeekSeconds, kGpsTime - 1e9, 1, "adjusted standard GPS times"},
    {TimeFormat::kGps, PointTimeForm::kAdjustedStandard, kGpsTime, 1, "GPS seconds since 1980"},
    {TimeFormat::kGps, PointTimeForm::kWeekSeconds, kGpsTime, 1, "GPS seconds since 1980"},
    {TimeFormat::kUnix, PointTimeForm::kAdjustedStandard, kUnix, 1, "Unix seconds"},
    {TimeFormat::kUnix, PointTimeForm::kWeekSeconds, kUnix, 1, "Unix seconds"},
    {TimeFormat::kDay, PointTimeForm::kWeekSeconds, kOfDay, 1, "seconds of the day, a Wednesday"},
    {TimeFormat::kUtcDay, PointTimeForm::kWeekSeconds, kOfDay - 17, 1, "UTC seconds of the day, a Wednesday"},
    {TimeFormat::kMilliseconds, PointTimeForm::kWeekSeconds, 1e3 * kOfWeek, 1e3, "milliseconds of the GPS week"},
    {TimeFormat::kMilliseconds, PointTimeForm::kAdjustedStandard, 1e3 * kOfDay, 1e3,
     "milliseconds of the day, a Wednesday"},
    {TimeFormat::kMilliseconds, PointTimeForm::kAdjustedStandard, 1e3 * kUnix, 1e3, "Unix milliseconds"},
};

PointTimes TimesOf(const Written& written) {
  return {{written.first, written.first + 1800 * written.unit}, written.header, GpsTimeOfDay(2016, 132)};
}

// Whether a clock reads the half hour.
bool IsRight(const PointClock& clock, const PointTimes& stated) {
  const PointTimes times = clock(stated.span);
  const double first = times.form == PointTimeForm::kWeekSeconds ? kOfWeek : kGpsTime - kAdjustedGpsOffset;
  return std::abs(times.span.first - first) < 1e-6 && std::abs(times.span.last - first - 1800) < 1e-6;
}

TEST(PointClock, OfEveryKindIsAmongThePossibleOnes) {
  for (const Written& written : kWritten) {
    const PointTimes stated = TimesOf(written);
    const std::vector<PointClock> clocks = ClocksOf(stated, TimeFormat::kAuto);
    EXPECT_EQ(clocks.front().form, written.header);
    EXPECT_FALSE(clocks.front().changes_times());
    EXPECT_FALSE(IsRight(clocks.front(), stated)) << written.description;
    int right = 0;
    for (const PointClock& clock : clocks) {
      if (!IsRight(clock, stated)) continue;
      ++right;
      EXPECT_EQ(clock.format, written.format) << written.description;
      EXPECT_EQ(clock.description, written.description);
    }
    EXPECT_EQ(right, 1) << written.description;
  }
}

TEST(PointClock, IsTheOneThatTheUserNames) {
  for (const Written& written : kWritten) {
    const PointTimes stated = TimesOf(written);
    int right = 0;
    for (const PointClock& clock : ClocksOf(stated, written.format)) {
      EXPECT_EQ(clock.format, written.format);
      right += IsRight(clock, stated);
    }
    EXPECT_EQ(right, 1) << written.description;
  }
  EXPECT_TRUE(ClocksOf({{kUnix, kUnix + 9}, PointTimeForm::kWeekSeconds}, TimeFormat::kWeek).empty());
  EXPECT_TRUE(ClocksOf({{kOfWeek, kOfWeek + 9}, PointTimeForm::kWeekSeconds}, TimeFormat::kUnix).empty());
}

}  // namespace
}  // namespace albtpu::formats
