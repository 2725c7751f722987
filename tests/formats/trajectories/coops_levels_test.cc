#include "formats/trajectories/coops_levels.h"

#include <gmock/gmock.h>

#include "absl/strings/str_replace.h"
#include "formats/clocks/trajectory_time.h"
#include "formats/trajectories/water_level_file.h"

namespace albtpu::formats {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Three times, of which the second has no level, in each form that CO-OPS delivers.
const std::string kCsv =
    " Date Time, Water Level, Sigma, O or I (for verified), F, R, L, Quality \n"
    "2016-05-11 14:00,0.213,0.003,0,0,0,0,v\n"
    "2016-05-11 14:06,,,,,,,\n"
    "2016-05-11 14:12,0.245,0.003,0,0,0,0,p\n";
const std::string kJson =
    "{\"metadata\":{\"id\":\"8723214\",\"name\":\"Virginia Key\",\"lat\":\"25.7317\",\"lon\":\"-80.1617\"},"
    "\"data\":[{\"t\":\"2016-05-11 14:00\",\"v\":\"0.213\",\"s\":\"0.003\",\"f\":\"0,0,0,0\",\"q\":\"v\"},"
    "{\"t\":\"2016-05-11 14:06\",\"v\":\"\",\"s\":\"\",\"f\":\"1,1,1,1\",\"q\":\"p\"},"
    "{\"t\":\"2016-05-11 14:12\",\"v\":\"0.245\",\"s\":\"0.003\",\"f\":\"0,0,0,0\",\"q\":\"p\"}]}";
const std::string kXml =
    "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<data>\n"
    "<metadata id=\"8723214\" name=\"Virginia Key\" lat=\"25.7317\" lon=\"-80.1617\"/>\n<observations>\n"
    "<wl t=\"2016-05-11 14:00\" v=\"0.213\" s=\"0.003\" f=\"0,0,0,0\" q=\"v\"/>\n"
    "<wl t=\"2016-05-11 14:06\" v=\"\" s=\"\" f=\"1,1,1,1\" q=\"p\" />\n"
    "<wl t=\"2016-05-11 14:12\" v=\"0.245\" s=\"0.003\" f=\"0,0,0,0\" q=\"p\"/>\n</observations>\n</data>\n";
const std::string kTable =
    "\"Date\",\"Time (GMT)\",\"Predicted (ft)\",\"Preliminary (ft)\",\"Verified (ft)\"\n"
    "\"2016/05/11\",\"14:00\",\"0.3\",\"0.9\",\"0.213\"\n"
    "\"2016/05/11\",\"14:06\",\"0.3\",\"-\",\"-\"\n"
    "\"2016/05/11\",\"14:12\",\"0.3\",\"0.245\",\"-\"\n";
constexpr char kPredictions[] = "Date Time, Prediction\n2016-05-11 14:00,0.213\n2016-05-11 14:12,0.245\n";

const double kStart = *ParseUtc("2016-05-11T14:00Z") - kAdjustedGpsOffset;

CoopsLevels ReadLevels(const std::string& text) {
  EXPECT_TRUE(AreCoopsLevels(text)) << text;
  const absl::StatusOr<CoopsLevels> levels = ReadCoopsLevels("co.csv", text);
  EXPECT_TRUE(levels.ok()) << levels.status();
  return *levels;
}

absl::StatusOr<WaterLevelSeries> Series(const std::string& text, const LevelReference& reference) {
  return ParseWaterLevels("co.csv", text, reference);
}
std::string ErrorOfSeries(const std::string& text, const LevelReference& reference = {.datum = "MLLW"}) {
  return std::string(Series(text, reference).status().message());
}

TEST(CoopsLevels, AreReadInEveryForm) {
  for (const std::string& text : {kCsv, kJson, kXml, kTable, "\xEF\xBB\xBF" + kCsv, "\xEF\xBB\xBF" + kJson,
                                  absl::StrReplaceAll(kTable, {{"\n", "\r\n"}})}) {
    SCOPED_TRACE(text);
    const CoopsLevels found = ReadLevels(text);
    ASSERT_EQ(found.levels.size(), 2u);
    EXPECT_EQ(found.levels[0].time, kStart + kAdjustedGpsOffset);
    EXPECT_EQ(found.levels[0].level, 0.213);
    EXPECT_EQ(found.levels[1].time, kStart + kAdjustedGpsOffset + 720);
    EXPECT_EQ(found.levels[1].level, 0.245);
    EXPECT_EQ(found.missing, 1u);
    EXPECT_EQ(found.preliminary, 1u);
    EXPECT_FALSE(found.predicted);
  }
  EXPECT_EQ(ReadLevels(kJson).station, "8723214 Virginia Key");
  EXPECT_EQ(ReadLevels(kXml).station, "8723214 Virginia Key");
  EXPECT_EQ(ReadLevels(kTable).metres, 0.3048);
  EXPECT_EQ(ReadLevels(kTable).zone, CoopsLevels::Zone::kGmt);
  EXPECT_EQ(ReadLevels(kCsv).metres, std::nullopt);
  EXPECT_TRUE(ReadLevels(kPredictions).predicted);
}

TEST(CoopsLevels, AreNotTheFormOfThisProject) {
  EXPECT_FALSE(AreCoopsLevels("time,water_level\n"));
  EXPECT_FALSE(AreCoopsLevels(""));
}

TEST(CoopsLevels, NeedTheNameOfTheirDatum) {
  EXPECT_THAT(ErrorOfSeries(kCsv, {}), HasSubstr("does not state the datum of its levels; name the one"));
  const auto series = Series(kCsv, {.datum = "MLLW", .offset = -26.5});
  ASSERT_TRUE(series.ok()) << series.status();
  EXPECT_NEAR(series->At(kStart).value(), 0.213 - 26.5, 1e-12);
  EXPECT_EQ(series->description(),
            "water levels of CO-OPS, 1 of 2 preliminary, 1 missing, times taken as GMT, in the unit of the points' "
            "heights, relative to MLLW; -26.5 is added for the datum of the points' heights");
  EXPECT_THAT(Series(kCsv, {.datum = "NAVD"})->description(),
              HasSubstr("relative to NAVD (taken as the datum of the points' heights"));
}

TEST(CoopsLevels, HaveTheTimeZoneThatTheyStateOrTheUserDoes) {
  const auto local = Series(kCsv, {.datum = "MLLW", .hours_from_utc = -4});
  ASSERT_TRUE(local.ok()) << local.status();
  EXPECT_EQ(local->start(), kStart + 4 * 3600);
  EXPECT_THAT(local->description(), Not(HasSubstr("GMT")));
  const std::string table = absl::StrReplaceAll(kTable, {{"(GMT)", "(LST/LDT)"}});
  EXPECT_THAT(ErrorOfSeries(table), HasSubstr("has times of a local zone; give its hours from UTC"));
  EXPECT_EQ(Series(table, {.datum = "MLLW", .hours_from_utc = -4})->start(), kStart + 4 * 3600);
  EXPECT_THAT(ErrorOfSeries(kTable, {.datum = "MLLW", .hours_from_utc = -4}), HasSubstr("states times in GMT"));
  EXPECT_THAT(ErrorOfSeries("time,water_level\n1,2\n2,3\n", {.hours_from_utc = 1}),
              HasSubstr("leave out --level-hours-from-utc"));
}

TEST(CoopsLevels, BecomeThoseOfTheUnitOfThePoints) {
  auto feet = Series(kTable, {.datum = "MLLW", .offset = 10});
  feet->TakeUnit(1);
  EXPECT_NEAR(feet->At(kStart).value(), 0.213 * 0.3048 + 10, 1e-12);
  auto unknown = Series(kCsv, {.datum = "MLLW"});
  unknown->TakeUnit(0.3048);
  EXPECT_EQ(unknown->At(kStart), 0.213);
}

TEST(CoopsLevels, NameWhatIsWrong) {
  EXPECT_THAT(ErrorOfSeries("{\"error\": {\"message\":\" No data was found.\"}}"),
              HasSubstr("co.csv: is an error of CO-OPS and no water levels ('No data was found.')"));
  EXPECT_THAT(ErrorOfSeries("<error> Wrong Datum </error>"), HasSubstr("('Wrong Datum')"));
  EXPECT_THAT(ErrorOfSeries("{\"data\":"), HasSubstr("is no sound JSON"));
  EXPECT_THAT(ErrorOfSeries("{\"a\":1}"), HasSubstr("neither data nor predictions"));
  EXPECT_THAT(ErrorOfSeries("<html><body>Not found</body></html>"), HasSubstr("has no elements wl"));
  EXPECT_THAT(ErrorOfSeries("<data><wl t=\"2016"), HasSubstr("ends within an element"));
  EXPECT_THAT(ErrorOfSeries(absl::StrReplaceAll(kCsv, {{"0.245", "x"}})), HasSubstr("line 4: 'x' is no water level"));
  EXPECT_THAT(ErrorOfSeries(absl::StrReplaceAll(kCsv, {{"14:12", "25:12"}})), HasSubstr("line 4: '2016-05-11 25:12'"));
  EXPECT_THAT(ErrorOfSeries(absl::StrReplaceAll(kCsv, {{"14:12", "13:12"}})), HasSubstr("sort it by time"));
  EXPECT_THAT(ErrorOfSeries(absl::StrReplaceAll(kJson, {{"0.245", "x"}})), HasSubstr("value 3: 'x' is no water level"));
  EXPECT_THAT(ErrorOfSeries("Date Time, Speed\n2016-05-11 14:00,1\n"), HasSubstr("no column of water levels"));
  EXPECT_THAT(ErrorOfSeries("Dates,Time (GMT),Verified (m)\n"), HasSubstr("no columns of dates"));
}

}  // namespace
}  // namespace albtpu::formats
