#include "formats/trajectories/water_level_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::TemporaryFolder;
using ::testing::HasSubstr;
using enum PointTimeForm;

absl::StatusOr<WaterLevelSeries> Parse(const std::string& text, PointTimeForm form = kAdjustedStandard) {
  const absl::StatusOr<WaterLevelSeries> series = ParseWaterLevels("tide.csv", text);
  return series.ok() ? series->In(form) : series;
}

std::string ErrorOfLevels(const std::string& text, PointTimeForm form = kAdjustedStandard) {
  return std::string(Parse(text, form).status().message());
}

// Of the single time in a file.
double GpsTimeOf(const std::string& utc) {
  const auto series = Parse(absl::StrCat("time,water_level\n", utc, ",1\n2099-01-01T00:00Z,2\n"));
  return series.ok() ? series->start() + kAdjustedGpsOffset : NAN;
}

TEST(WaterLevels, AreLinearBetweenTwo) {
  const auto series = Parse("time,water_level\n1000,-23\n1360,-23.5\n1720,-23\n");
  EXPECT_EQ(series->size(), 3u);
  EXPECT_EQ(series->At(1000), -23);
  EXPECT_EQ(series->At(1180), -23.25);
  EXPECT_EQ(series->At(1360), -23.5);
  EXPECT_EQ(series->At(1450), -23.375);
  EXPECT_EQ(series->At(1720), -23);
}

TEST(WaterLevels, AreNotExtrapolated) {
  const auto series = Parse("time,water_level\n1000,-23\n1360,-23.5\n");
  EXPECT_FALSE(series->At(999.999).has_value());
  EXPECT_FALSE(series->At(1360.001).has_value());
  EXPECT_FALSE(series->At(NAN).has_value());
  EXPECT_FALSE(series->At(INFINITY).has_value());
}

TEST(WaterLevels, DoNotBridgeAGap) {
  const auto series = Parse("time,water_level\n0,1\n7200,2\n14400.5,3\n14500,4\n");
  EXPECT_EQ(series->At(3600), 1.5);
  EXPECT_EQ(series->At(7200), 2);
  EXPECT_FALSE(series->At(7201).has_value());
  EXPECT_FALSE(series->At(14400).has_value());
  EXPECT_EQ(series->At(14400.5), 3);
}

TEST(WaterLevels, AreTheSameForColumnsOfTimes) {
  const auto series = Parse("time,water_level\n0,1\n360,2\n20000,3\n20360,4\n20720,-1\n");
  std::vector<double> times = {NAN, INFINITY, -INFINITY, 0, 360, 20000, 20720, 20719.5, 1e300};
  for (double time = -100; time < 21000; time += 7.7) times.push_back(time);
  for (double time = 21000; time > -100; time -= 13.3) times.push_back(time);
  std::vector<double> levels(times.size());
  series->LevelsAt(times, levels);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::optional<double> level = series->At(times[i]);
    ASSERT_EQ(std::isnan(levels[i]), !level.has_value()) << times[i];
    if (level.has_value()) {
      ASSERT_EQ(levels[i], *level) << times[i];
    }
  }
}

TEST(WaterLevels, TakeColumnsByName) {
  const auto series = Parse("station,\"water_level\", time ,note\r\nA,2.5,100,\"a, b\"\r\n\r\nA, 3.5 ,200,\r\n");
  EXPECT_EQ(series->At(150), 3);
}

// GPS - UTC was 0 in January 1980; the table of leap seconds is that of the IERS (leap-seconds.list), whose dates the
// times below bracket.
TEST(WaterLevels, TakeUtcWithItsLeapSeconds) {
  constexpr double kDay = 86400;
  EXPECT_EQ(GpsTimeOf("1980-01-06T00:00:00Z"), 0);
  EXPECT_EQ(GpsTimeOf("1981-06-30T23:59:59Z"), 541 * kDay + kDay - 1);
  EXPECT_EQ(GpsTimeOf("1981-07-01T00:00:00Z"), 542 * kDay + 1);
  // 36 years, 10 leap days from 1980 to 2016, and 125 days from 6 January to 11 May of a common year.
  EXPECT_EQ(GpsTimeOf("2016-05-11T14:00:00Z"), 13275 * kDay + 14 * 3600 + 17);
  EXPECT_EQ(GpsTimeOf("2015-06-30T23:59:59.5Z"), 12959 * kDay + kDay - 0.5 + 16);
  EXPECT_EQ(GpsTimeOf("2015-07-01T00:00:00Z"), 12960 * kDay + 17);
  EXPECT_EQ(GpsTimeOf("2016-12-31 23:59:59Z"), 13509 * kDay + kDay - 1 + 17);
  EXPECT_EQ(GpsTimeOf("2017-01-01 00:00Z"), 13510 * kDay + 18);
}

TEST(WaterLevels, RefuseOtherDates) {
  for (const char* text : {"2016-05-11T14:00:00", "2016-05-11", "2016-05-11T14:00:00+02:00", "2016-02-30T00:00:00Z",
                           "2016-13-01T00:00:00Z", "2016-05-11T24:00:00Z", "2016-05-11T14:60:00Z",
                           "2016-05-11T14:00:60Z", "2016-05-11T14:00:nanZ", "2016-05-11T14:00:Z", "11.5.2016 14:00",
                           "2016-05-11T14Z", "2016/05/11 14:00Z", "nan", "inf", "", "1e300", "infinite-future"}) {
    EXPECT_THAT(ErrorOfLevels(absl::StrCat("time,water_level\n", text, ",1\n")),
                HasSubstr("tide.csv line 2, column 'time': '"))
        << text;
  }
}

TEST(WaterLevels, BecomeSecondsOfTheWeekForPointsThatStateThem) {
  // Sunday 2016-05-08 0:00 GPS begins the week, 17 s before UTC.
  const std::string text = "time,water_level\n2016-05-11T14:00:00Z,1\n2016-05-11T15:00:00Z,2\n";
  const auto series = Parse(text, kWeekSeconds);
  EXPECT_EQ(series->At(3 * 86400 + 14 * 3600 + 17), 1);
  EXPECT_EQ(series->At(3 * 86400 + 14.5 * 3600 + 17), 1.5);
  const auto saturday = Parse("time,water_level\n2016-05-14T23:30:00Z,1\n2016-05-15T00:30:00Z,2\n", kWeekSeconds);
  EXPECT_EQ(saturday->At(7 * 86400 - 1800 + 17), 1);
  EXPECT_EQ(saturday->At(17), 1.5);
  EXPECT_EQ(saturday->At(7 * 86400 + 17), 1.5);
  EXPECT_THAT(ErrorOfLevels("time,water_level\n2016-05-01T14:00:00Z,1\n2016-05-11T15:00:00Z,2\n", kWeekSeconds),
              HasSubstr("covers more than a week"));
}

TEST(WaterLevels, GoOnWhereTheWeekEnds) {
  const auto series = Parse("time,water_level\n604500,1\n100,2\n500,3\n", kWeekSeconds);
  EXPECT_EQ(series->At(604700), 1.5);
  EXPECT_EQ(series->At(300), 2.5);
  EXPECT_EQ(series->At(604800 + 300), 2.5);
}

TEST(WaterLevels, NameWhatIsWrong) {
  EXPECT_THAT(ErrorOfLevels(""), HasSubstr("tide.csv: is empty"));
  EXPECT_THAT(ErrorOfLevels("time,water_level\n"), HasSubstr("fewer than two"));
  EXPECT_THAT(ErrorOfLevels("time,water_level\n1,2\n"), HasSubstr("fewer than two"));
  EXPECT_THAT(ErrorOfLevels("time,level\n1,2\n"), HasSubstr("line 1: there is no column 'water_level'"));
  EXPECT_THAT(ErrorOfLevels("water_level\n1\n"), HasSubstr("line 1: there is no column 'time'"));
  EXPECT_THAT(ErrorOfLevels("time,water_level,time\n"), HasSubstr("column 'time': occurs twice"));
  EXPECT_THAT(ErrorOfLevels("time,water_level\n1,2\n1,3\n"), HasSubstr("line 3, column 'time': '1' is not after"));
  EXPECT_THAT(ErrorOfLevels("time,water_level\n5,2\n1,3\n"), HasSubstr("line 3, column 'time': '1' is not after"));
  EXPECT_THAT(ErrorOfLevels("time,water_level\n5,x\n"),
              HasSubstr("line 2, column 'water_level': 'x' is not a water level"));
  EXPECT_THAT(ErrorOfLevels("time,water_level\n5,nan\n"), HasSubstr("line 2, column 'water_level'"));
  EXPECT_THAT(ErrorOfLevels("time,water_level\n5\n"), HasSubstr("line 2: has 1 cells"));
  EXPECT_THAT(ErrorOfLevels("time,water_level\n5,-2,5\n"), HasSubstr("line 2: has 3 cells"));
  EXPECT_THAT(ErrorOfLevels("time,water_level\n5,-2,5\n"), HasSubstr("a decimal comma"));
  EXPECT_THAT(ErrorOfLevels("time,water_level\n5,1\n2016-05-11T14:00:00Z,1\n"), HasSubstr("line 3, column 'time'"));
  EXPECT_THAT(ErrorOfLevels("time,water_level\n\"5,1\n"),
              HasSubstr("line 2: the record that begins here does not end"));
}

TEST(WaterLevels, AreReadFromAFile) {
  const TemporaryFolder folder;
  std::string text = "time,water_level\n";
  for (int i = 0; i < 200000; ++i) absl::StrAppend(&text, i, ",", i % 7, "\n");
  const auto series = ReadWaterLevels(folder.Write("tide.csv", text));
  EXPECT_EQ(series->size(), 200000u);
  EXPECT_EQ(series->At(100000), 100000 % 7);
  EXPECT_THAT(std::string(ReadWaterLevels(folder / "no").status().message()), HasSubstr("No such file"));
  EXPECT_THAT(std::string(ReadWaterLevels(folder.path()).status().message()), HasSubstr("is a folder"));
}

TEST(WaterLevels, AreNotNumbersThatStandForMissingLevels) {
  const TemporaryFolder folder;
  for (const double missing : {-9999.0, 9999.0, 99.99, -99.99, 999.9}) {
    const std::filesystem::path path =
        folder.Write(absl::StrFormat("tide%g.csv", missing),
                     absl::StrFormat("time,water_level\n100,-23.5\n460,-23.5\n820,%g\n1180,-23.4\n", missing));
    const auto levels = ReadWaterLevels(path);
    EXPECT_THAT(std::string(levels.status().message()), HasSubstr("goes from -23.5 to")) << missing;
  }
}

// A row of levels, `seconds` apart.
std::string LevelText(const std::vector<double>& levels, double seconds) {
  std::string text = "time,water_level\n";
  for (std::size_t i = 0; i < levels.size(); ++i)
    absl::StrAppend(&text, seconds * static_cast<double>(i), ",", levels[i], "\n");
  return text;
}

TEST(WaterLevels, AreNotAlonePastBothNeighbours) {
  for (const double missing : {9.999, -9.99, 0.0, -20.5})
    for (const double seconds : {60, 360})
      EXPECT_THAT(ErrorOfLevels(LevelText({-23.5, -23.5, missing, -23.4, -23.4}, seconds)),
                  HasSubstr(absl::StrFormat("tide.csv: goes from -23.5 to %g and back to -23.4 within ", missing)));
  EXPECT_THAT(ErrorOfLevels(LevelText({-23.5, -23.5, 0, -23.5}, 3600)),
              HasSubstr("within 120 minutes, which no water does: 0 stands for a missing level; remove it"));
}

TEST(WaterLevels, DoNotStepToAnotherDatum) {
  for (const double seconds : {360, 3600})
    EXPECT_THAT(ErrorOfLevels(LevelText({0.3, 0.3, -23.5, -23.5}, seconds)),
                HasSubstr("goes from 0.3 to -23.5 within"));
  EXPECT_THAT(
      ErrorOfLevels(LevelText({9.999, -23.5, -23.5}, 360)),
      HasSubstr("within 6 minutes, which no water does: one of them stands for a missing level, or another datum "
                "begins there; remove it, or give the levels of one datum"));
}

// The greatest tide, 16.3 m or 53.5 feet in half of 12.42 h, in steps of a minute to two hours, with a bore of 1.6 m
// when it rises fastest.
TEST(WaterLevels, RiseAsTheGreatestTidesDo) {
  for (const double seconds : {60, 360, 900, 3600, 7200}) {
    for (const double range : {16.3, 53.5}) {
      std::vector<double> levels;
      for (double time = 0; time < 2 * 44712; time += seconds)
        levels.push_back(range / 2 * std::sin(2 * std::numbers::pi * time / 44712) + (time > 44712 ? range / 10 : 0));
      EXPECT_EQ(ErrorOfLevels(LevelText(levels, seconds)), "") << seconds << " " << range;
    }
  }
}

// Nothing is interpolated between levels of different days.
TEST(WaterLevels, OfLakesMayDifferFromDayToDay) {
  EXPECT_EQ(ErrorOfLevels(LevelText({178.3, 188.1, 178.3}, 86400)), "");
}

}  // namespace
}  // namespace albtpu::formats
