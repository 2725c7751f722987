#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <string>

#include "config/survey_settings.h"
#include "tests/config/parsed_survey.h"
#include "tests/temporary_folder.h"

namespace albtpu::config {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr char kTwoWaves[] = R"([sea]
wind_speed = 6.5
wind_from = 225
water_depth = 12
tail = "level"
tail_from = 0.95
[[sea.waves]]
hs = 0.42
tp = 2.7
waves_from = 225
spreading = "mitsuyasu"
[[sea.waves]]
hs = 1
tp = 9.5
gamma = 7
waves_from = 295
spread = 18
)";

TEST(SurveyFile, HasASea) {
  const absl::StatusOr<SurveySettings> survey = ParseSurvey(kTwoWaves, "");
  ASSERT_TRUE(survey.ok()) << survey.status();
  const SeaSettings& sea = survey->sea;
  EXPECT_EQ(sea.wind_speed, 6.5);
  EXPECT_EQ(sea.wind_from, 225);
  EXPECT_EQ(sea.water_depth, 12);
  EXPECT_EQ(sea.tail, "level");
  EXPECT_EQ(sea.tail_from, 0.95);
  ASSERT_EQ(sea.waves.size(), 2u);
  EXPECT_EQ(sea.waves[0].significant_wave_height, 0.42);
  EXPECT_EQ(sea.waves[0].peak_period, 2.7);
  EXPECT_EQ(sea.waves[0].gamma, 3.3);
  EXPECT_FALSE(sea.waves[0].spread.has_value());
  EXPECT_DOUBLE_EQ(sea.waves[0].travels_towards, 405 * std::numbers::pi / 180);
  EXPECT_EQ(sea.waves[1].gamma, 7);
  EXPECT_DOUBLE_EQ(sea.waves[1].spread.value(), std::numbers::pi / 10);
  EXPECT_TRUE(CheckSea(sea).ok());
}

TEST(SurveyFile, MayBeEmpty) {
  EXPECT_FALSE(IsAnyGiven(kSeaKeys, ParseSurvey("", "").value().sea));
  EXPECT_FALSE(ParseSurvey("[sea]\n", "").value().sea.has_waves());
  EXPECT_EQ(ParseSurvey("[sea]\nwind_speed = 0\n", "").value().sea.wind_speed, 0);
}

TEST(SurveyFile, FindsFilesFromItsOwnFolder) {
  const std::string text =
      "[sea]\nfile = \"41010.data_spec\"\ntime = \"2020-06-08T03:50Z\"\nplace = \"A\"\n"
      "longest_gap = 6\nanemometer_height = 4\n";
  const SeaSettings sea = ParseSurvey(text, "/data").value().sea;
  EXPECT_EQ(sea.file, "/data/41010.data_spec");
  EXPECT_EQ(sea.time, "2020-06-08T03:50Z");
  EXPECT_EQ(sea.place, "A");
  EXPECT_EQ(sea.longest_gap, 6);
  EXPECT_EQ(sea.anemometer_height, 4);
  EXPECT_EQ(ParseSurvey("sea.file = '/other/x'", "/data").value().sea.file, "/other/x");
}

TEST(SurveyFile, RefusesWrongTexts) {
  EXPECT_EQ(ErrorOf("[sea]\ntail = \"relaxed\"\n"),
            "line 2: 'sea.tail' is 'relaxed' (expected relax, wind, level, none); did you mean \"relax\"?");
  EXPECT_THAT(ErrorOf("[sea]\ntail = \"up\"\n"), HasSubstr("give one of them"));
  EXPECT_THAT(ErrorOf("[sea]\ntime = \"yesterday\"\n"), HasSubstr("give UTC as \"2020-06-08T03:50Z\""));
  EXPECT_THAT(ErrorOf("[[sea.waves]]\nspreading = 'narrow'\n"), StartsWith("line 2: 'sea.waves.spreading' is "));
}

TEST(SurveyFile, NamesTheKeyThatIsMissing) {
  for (const char* key : {"hs", "tp", "waves_from"}) {
    std::string text = "[[sea.waves]]\n";
    for (const char* other : {"hs = 1\n", "tp = 5\n", "waves_from = 20\n"})
      if (!std::string(other).starts_with(key)) text += other;
    EXPECT_THAT(ErrorOf(text), StartsWith("line 1: [sea.waves] " + std::string(key) + " is missing; give a number"));
  }
  EXPECT_THAT(ErrorOf("[[sea.waves]]\nhs=1\ntp=5\nwaves_from=20\nspread=18\nspreading='mitsuyasu'\n"),
              HasSubstr("both say how directions spread"));
}

TEST(SurveyFile, NamesTheKeyThatIsMeant) {
  EXPECT_THAT(ErrorOf("[sea]\nwind_sped = 5\n"),
              StartsWith("line 2: 'sea.wind_sped' is no key of a survey file; did you mean wind_speed?"));
  EXPECT_THAT(ErrorOf("[see]\n"), HasSubstr("did you mean sea?"));
  EXPECT_THAT(ErrorOf("[[sea.waves]]\nhs=1\ntp=5\nwaves_from=20\nheight=2\n"),
              StartsWith("line 5: 'sea.waves.height'"));
  EXPECT_THAT(ErrorOf("x = 1\n"), HasSubstr("there are datum, extra, output, project, sea, sensor"));
}

TEST(SurveyFile, RefusesTablesThatAreNone) {
  EXPECT_THAT(ErrorOf("sea = 5\n"), StartsWith("line 1: 'sea' is 5 (expected a table); begin it with [sea]"));
  EXPECT_THAT(ErrorOf("[[sea]]\nwind_speed = 5\n"), HasSubstr("begin it with [sea]"));
  for (const char* waves :
       {"[sea.waves]\nhs = 1\n", "sea.waves = []\n", "sea.waves = [1, {hs=1}]\n", "sea.waves = 1\n"})
    EXPECT_THAT(ErrorOf(waves), HasSubstr("begin each of them with [[sea.waves]]")) << waves;
}

TEST(SurveyFile, RefusesWhatIsNoToml) {
  EXPECT_THAT(ErrorOf("[sea]\nwind_speed = \n"), StartsWith("line 2: is not TOML ("));
  EXPECT_THAT(ErrorOf("[sea]\nwind_speed = 5\nwind_speed = 6\n"), StartsWith("line 3: is not TOML ("));
  EXPECT_THAT(ErrorOf(std::string(40000, ' ')), HasSubstr("has 40000 bytes"));
  EXPECT_THAT(ErrorOf(std::string("\x89HDF\r\n\x1a\n", 8)), HasSubstr("is not TOML"));
}

TEST(SurveyFile, AnswersOnOneLineToKeysOfSeveral) {
  EXPECT_THAT(ErrorOf("[sea]\n\"wind\\nspeed\" = 5\n"), StartsWith("line 2: 'sea.wind?speed' is no key"));
  EXPECT_EQ(ErrorOf("[sea]\ntail = \"a\\nb\"\n").find('\n'), std::string::npos);
}

// Whatever is left of a file is the same description without its end, or one message.
TEST(SurveyFile, MayBeCutAnywhere) {
  const std::string text = kTwoWaves;
  for (std::size_t size = 0; size < text.size(); ++size) {
    const absl::StatusOr<SurveySettings> survey = ParseSurvey(text.substr(0, size), "");
    if (survey.ok()) continue;
    EXPECT_THAT(std::string(survey.status().message()), StartsWith("line ")) << size;
    EXPECT_EQ(survey.status().message().find('\n'), std::string::npos) << size;
  }
}

TEST(ReadSurvey, NamesTheFile) {
  const albtpu::testing::TemporaryFolder folder;
  const std::filesystem::path path = folder / "survey.toml";
  EXPECT_THAT(std::string(ReadSurvey(path).status().message()), StartsWith(path.string() + ": does not exist"));
  EXPECT_THAT(std::string(ReadSurvey(path.parent_path()).status().message()), HasSubstr("is not a regular file"));
  std::ofstream(path) << "[sea]\ntail = 5\n";
  EXPECT_THAT(std::string(ReadSurvey(path).status().message()), StartsWith(path.string() + ": line 2: 'sea.tail'"));
  std::ofstream(path) << "[sea]\nfile = \"a.spec\"\n";
  EXPECT_EQ(ReadSurvey(path).value().sea.file, (path.parent_path() / "a.spec").string());
}

}  // namespace
}  // namespace albtpu::config
