#include "formats/trajectories/water_levels.h"

#include <gmock/gmock.h>

#include "absl/strings/str_format.h"
#include "formats/trajectories/water_level_file.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::TemporaryFolder;
using ::testing::HasSubstr;
using enum PointTimeForm;

absl::StatusOr<WaterLevelSeries> Find(const std::filesystem::path& path, const PointTimes& points, TimeFormat format,
                                      std::string& note) {
  const absl::StatusOr<WaterLevelSeries> series = ReadWaterLevels(path);
  return series.ok() ? series->For(points, {.format = format}, note) : series;
}

// Points of Wednesday in seconds of the day, levels of the same hours of a day: that of the trajectory decides.
TEST(WaterLevelsFor, KeepsToTheClockOfTheTrajectory) {
  const TemporaryFolder folder;
  const PointTimes points = {{51017, 51077}, kWeekSeconds};  // 14:10:00Z
  const ClockChoice wednesday = {.of_track = PointClock{.format = TimeFormat::kDay,
                                                        .shift = 3 * 86400,
                                                        .form = kWeekSeconds,
                                                        .description = "seconds of the day, a Wednesday"}};
  std::string note = "none";
  for (const int day : {8, 11, 12}) {  // A Sunday, as the header says, Wednesday and Thursday.
    const auto path = folder.Write("tide.csv", absl::StrFormat("time,water_level\n2016-05-%02dT14:00:00Z,1\n"
                                                               "2016-05-%02dT14:20:00Z,2\n",
                                                               day, day));
    EXPECT_TRUE(Find(path, points, TimeFormat::kAuto, note).ok());
    const auto levels = ReadWaterLevels(path)->For(points, wednesday, note);
    EXPECT_EQ(levels.ok(), day == 11) << day;
    EXPECT_EQ(note, "");
    if (levels.ok())
      EXPECT_NEAR(levels->At(51017).value_or(-1), 1.5, 1e-9);
    else
      EXPECT_THAT(std::string(levels.status().message()), HasSubstr("a Wednesday, as the trajectory has them; give"));
  }
}

// 2016-05-11T14:10:00Z, 600 s after the first level, by every clock; GPS is 17 s ahead of UTC. The levels are 1 to 2 m
// in 20 minutes.
TEST(WaterLevelsFor, ReadsTheTimesOfThePointsByWhatFits) {
  constexpr double kUnix = 1462975800, kGps = kUnix - 315964800 + 17, kOfWeek = kGps - 1896 * kSecondsPerWeek;
  const TemporaryFolder folder;
  const std::filesystem::path path =
      folder.Write("tide.csv", "time,water_level\n2016-05-11T14:00:00Z,1\n2016-05-11T14:20:00Z,2\n");
  const struct {
    double time, unit;
    PointTimeForm header;
    const char* format;  // Empty: as the header states.
  } kPoints[] = {{kGps - 1e9, 1, kAdjustedStandard, ""},
                 {kOfWeek, 1, kWeekSeconds, ""},
                 {kGps - 1e9, 1, kWeekSeconds, "adjusted"},
                 {kOfWeek, 1, kAdjustedStandard, "week"},
                 {kGps, 1, kAdjustedStandard, "gps"},
                 {kUnix, 1, kWeekSeconds, "unix"},
                 {kOfWeek * 1e3, 1e3, kWeekSeconds, "milliseconds"},
                 {kOfWeek - 3 * 86400, 1, kWeekSeconds, "day"}};
  for (const auto& points : kPoints) {
    std::string note = "none";
    const auto levels =
        Find(path, {{points.time, points.time + 60 * points.unit}, points.header}, TimeFormat::kAuto, note);
    ASSERT_TRUE(levels.ok()) << points.format << levels.status();
    EXPECT_NEAR(levels->At(points.time).value_or(-1), 1.5, 1e-9) << points.format;
    EXPECT_NEAR(levels->At(points.time + 60 * points.unit).value_or(-1), 1.55, 1e-9) << points.format;
    if (*points.format == '\0')
      EXPECT_EQ(note, "");
    else
      EXPECT_THAT(note, HasSubstr(std::string("--time-format ") + points.format + " says so"));
  }
  // Of another day: there is no level.
  std::string note;
  const auto none = Find(path, {{kUnix + 2e5, kUnix + 2e5 + 60}, kWeekSeconds}, TimeFormat::kAuto, note);
  EXPECT_FALSE(none->At(kUnix + 2e5).has_value());
  EXPECT_THAT(note, HasSubstr("tide.csv: has no level at the times of the points: it has 2016-05-11T14:00:00Z to"));
  const auto other = Find(path, {{kOfWeek, kOfWeek + 60}, kWeekSeconds}, TimeFormat::kUnix, note);
  EXPECT_THAT(std::string(other.status().message()), HasSubstr("if --time-format unix is right"));
}

// Levels from Friday to Monday.
std::filesystem::path WriteOverTheEndOfAWeek(const TemporaryFolder& folder) {
  std::string text = "time,water_level\n";
  for (int day = 13; day <= 16; ++day)
    for (int hour = 0; hour < 24; ++hour) absl::StrAppendFormat(&text, "2016-05-%02dT%02d:00:00Z,%d\n", day, hour, day);
  return folder.Write("tide.csv", text);
}

TEST(WaterLevelsFor, ReadsTheTimesOfThePointsByWhatFitsOverTheEndOfAWeek) {
  const TemporaryFolder folder;
  const std::filesystem::path path = WriteOverTheEndOfAWeek(folder);
  constexpr double kSaturday = 1463227200 + 7200 - 315964800 + 17 - 1e9;  // 2016-05-14T14:00:00Z, adjusted.
  std::string note;
  const auto levels = Find(path, {{kSaturday, kSaturday + 60}, kWeekSeconds}, TimeFormat::kAuto, note);
  ASSERT_TRUE(levels.ok()) << levels.status();
  EXPECT_EQ(levels->At(kSaturday), 14);
  EXPECT_THAT(note, HasSubstr("--time-format adjusted says so"));
}

// Sunday afternoon after the last level, and the same hour of Saturday with levels.
TEST(WaterLevelsFor, TakesNoDayByChanceOverTheEndOfAWeek) {
  const TemporaryFolder folder;
  const auto path = folder.Write("tide.csv",
                                 "time,water_level\n2016-05-14T12:00:00Z,1\n2016-05-14T14:00:00Z,1\n"
                                 "2016-05-15T12:00:00Z,1\n");
  std::string note;
  const auto levels = Find(path, {{48000, 48060}, kWeekSeconds, GpsTimeOfDay(2016, 200)}, TimeFormat::kAuto, note);
  ASSERT_TRUE(levels.ok()) << levels.status();
  EXPECT_FALSE(levels->At(48000).has_value());
  EXPECT_THAT(note, HasSubstr("has no level at the times of the points"));
}

TEST(WaterLevelsReadingOf, NamesTheWeekOfThePoints) {
  const TemporaryFolder folder;
  const std::filesystem::path path = WriteOverTheEndOfAWeek(folder);
  constexpr double kBegin = 1896 * kSecondsPerWeek - kAdjustedGpsOffset;  // 2016-05-08
  std::string note;
  // The first ones begin before the levels do.
  for (const auto& [first, weeks] : {std::pair(5 * 86400 - 30.0, 0), {604790.0, 0}, {7200.0, 1}}) {
    const PointTimes points = {{first, first + 60}, kWeekSeconds};
    const auto levels = Find(path, points, TimeFormat::kAuto, note);
    const std::optional<ClockReading> reading = levels->ReadingOf(points);
    ASSERT_TRUE(reading.has_value()) << first;
    EXPECT_NEAR((*reading)(first), kBegin + weeks * kSecondsPerWeek + first, 1e-6);
  }
}

TEST(WaterLevelsFor, TakesTheWeekOfTheCreationOfThePoints) {
  constexpr double kOfWeek = 4 * 86400 + 600 + 17;
  const TemporaryFolder folder;
  std::string text = "time,water_level\n";
  for (int day = 1; day <= 28; ++day)
    for (int hour = 0; hour < 24; ++hour) absl::StrAppendFormat(&text, "2016-05-%02dT%02d:00:00Z,%d\n", day, hour, day);
  const std::filesystem::path path = folder.Write("tide.csv", text);
  std::string note;
  // 2016-05-12 is a Thursday, and the day 133.
  const PointTimes points = {{kOfWeek, kOfWeek + 60}, kWeekSeconds, GpsTimeOfDay(2016, 133)};
  const auto levels = Find(path, points, TimeFormat::kAuto, note);
  ASSERT_TRUE(levels.ok()) << levels.status();
  EXPECT_EQ(levels->At(kOfWeek), 12);
  EXPECT_THAT(note, HasSubstr("2016-05-12 is taken because of the creation of the file on 2016-05-12"));
  const auto open = Find(path, {points.span, kWeekSeconds}, TimeFormat::kAuto, note);
  EXPECT_THAT(std::string(open.status().message()),
              HasSubstr("seconds of the GPS week (2016-05-05) or as seconds of the GPS week (2016-05-12)"));
}

// 2016-05-11T14:00:00Z to 14:20:00Z as numbers of other clocks than that of the points, which are 10 minutes later.
TEST(WaterLevelsFor, ReadsNumbersByTheClockOfDatesThatFits) {
  constexpr double kUnix = 1462975200, kGps = kUnix - 315964800 + 17, kOfWeek = kGps - 1896 * kSecondsPerWeek;
  const TemporaryFolder folder;
  const auto write = [&](const char* name, double start, double level = 1) {
    return folder.Write(name, absl::StrFormat("time,water_level\n%.1f,%g\n%.1f,2\n", start, level, start + 1200));
  };
  const std::filesystem::path unix = write("unix.csv", kUnix), gps = write("gps.csv", kGps),
                              adjusted = write("adjusted.csv", kGps - 1e9);
  const struct {
    std::filesystem::path file;
    PointTimes points;
    std::string said;
  } kCases[] = {
      {unix, {{kGps - 1e9 + 600, kGps - 1e9 + 660}, kAdjustedStandard}, "unix.csv are Unix seconds (2016-05-11"},
      {unix, {{kOfWeek + 600, kOfWeek + 660}, kWeekSeconds}, "unix.csv are Unix seconds (2016-05-11"},
      {gps, {{kGps - 1e9 + 600, kGps - 1e9 + 660}, kAdjustedStandard}, "are GPS seconds since 1980 (2016-05"},
      {gps, {{kUnix + 600, kUnix + 660}, kAdjustedStandard}, "whose GPS times are Unix seconds"},
      {adjusted, {{kOfWeek + 600, kOfWeek + 660}, kWeekSeconds}, "are adjusted standard GPS times (2016-05"}};
  for (const auto& [file, points, said] : kCases) {
    std::string note;
    const auto levels = Find(file, points, TimeFormat::kAuto, note);
    ASSERT_TRUE(levels.ok()) << levels.status();
    EXPECT_NEAR(levels->At(points.span.first).value_or(-1), 1.5, 1e-9) << said;
    EXPECT_THAT(note, HasSubstr(said));
  }
  // In the form of the points, whatever it is, nothing is said.
  std::string note = "none";
  EXPECT_EQ(Find(unix, {{kUnix + 600, kUnix + 660}, kAdjustedStandard}, TimeFormat::kAuto, note)->At(kUnix + 600), 1.5);
  EXPECT_EQ(note, "");
}

TEST(WaterLevelsFor, SaysWhatNumbersAreThatLieAtNoPoint) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.Write("tide.csv", "time,water_level\n1462975200,1\n1462976400,2\n");
  std::string note;
  const auto levels = Find(path, {{3e8, 3e8 + 60}, kAdjustedStandard}, TimeFormat::kAuto, note);
  EXPECT_FALSE(levels->At(3e8).has_value());
  EXPECT_THAT(note, HasSubstr("has no level at the times of the points: it has 1462975200.0 to 1462976400.0 s"));
  EXPECT_THAT(note, HasSubstr(", as Unix seconds 2016-05-11T14:00:00Z to 2016-05-11T14:20:00Z, they have "));
}

}  // namespace
}  // namespace albtpu::formats
