#include <gmock/gmock.h>

#include "formats/trajectories/trajectory_time.h"
#include "sea/sea_time.h"

namespace albtpu::formats {
namespace {

using ::testing::HasSubstr;

double Utc(const char* text) { return ParseSeaTime(text).value(); }
double Gps(const char* text) { return ParseUtc(text).value(); }

TimeSpan Span(const char* first, const char* last) { return {Utc(first), Utc(last)}; }

PointTimes Adjusted(const char* first, const char* last) {
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
    const PointTimes points = Adjusted(text, text);
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
  EXPECT_THAT(ErrorOf(Adjusted("2020-06-10T00:00:00Z", "2020-06-10T02:00:00Z"), known),
              HasSubstr("the file 2020-06-07T12:00:00Z to 2020-06-09T12:00:00Z"));
}

}  // namespace
}  // namespace albtpu::formats
