#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "config/survey_settings.h"
#include "tests/config/parsed_survey.h"

namespace albtpu::config {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr char kWhole[] = R"([sensor]
name = "riegl-vq-880-g"
lever_arm = [0.3, -0.2, 0.5]
[trajectory]
files = ["sbet/", "/data/b.out"]
errors = ["smrmsg/"]
time = "utc"
[surface]
classes = [41, 42]
located = "local"
[sea]
wind_speed = 5
[water]
kd = 0.12
temperature = 24
salinity = 36
index = 1.3397
[datum]
sigma = 0.08
geoid_separation = -25.1
region = "Delaware - Delaware Bay"
[extra]
horizontal = 0.2
vertical = 0.05
[sigma]
position = [0.02, 0.02, 0.06]
attitude = [0.005, 0, 0.008]
boresight = [0, 0, 0]
lever_arm = 0.02
scan = 0.02
time = 1e-5
range_offset = 0.01
bottom_range = 0.025
surface_height = 0
index = 0.001
[output]
classes = [40]
coverage = "p95"
s44_order = "1b"
details = true
)";

TEST(SurveySections, SayAllOfASurvey) {
  const SurveySettings survey = Survey(kWhole);
  EXPECT_EQ(survey.sensor.name, "riegl-vq-880-g");
  EXPECT_THAT(survey.sensor.lever_arm.value(), ElementsAre(0.3, -0.2, 0.5));
  EXPECT_THAT(survey.trajectory.files, ElementsAre("/data/sbet/", "/data/b.out"));
  EXPECT_THAT(survey.trajectory.errors, ElementsAre("/data/smrmsg/"));
  EXPECT_EQ(survey.trajectory.time, "utc");
  EXPECT_FALSE(survey.trajectory.from_returns.has_value());
  EXPECT_THAT(survey.surface.classes, ElementsAre(41, 42));
  EXPECT_EQ(survey.surface.located, "local");
  EXPECT_EQ(survey.sea.wind_speed, 5);
  EXPECT_EQ(survey.water.kd, 0.12);
  EXPECT_EQ(survey.water.temperature, 24);
  EXPECT_EQ(survey.water.salinity, 36);
  EXPECT_EQ(survey.water.index, 1.3397);
  EXPECT_FALSE(survey.water.without_column());
  EXPECT_EQ(survey.datum.sigma, 0.08);
  EXPECT_EQ(survey.datum.standard_deviation(), 0.08);
  EXPECT_EQ(survey.datum.region, "Delaware - Delaware Bay");
  EXPECT_EQ(survey.extra.horizontal, 0.2);
  EXPECT_EQ(survey.extra.vertical, 0.05);
  EXPECT_EQ(survey.datum.geoid_separation, -25.1);
  const config::StatedErrors& sigma = survey.sigma;
  EXPECT_THAT(sigma.values.position, ElementsAre(0.02, 0.02, 0.06));
  EXPECT_THAT(sigma.values.attitude, ElementsAre(0.005, 0, 0.008));
  EXPECT_EQ(sigma.values.scan, 0.02);
  EXPECT_EQ(sigma.values.surface_height, 0);
  EXPECT_TRUE(sigma.Has(&AirErrors::surface_height));
  EXPECT_FALSE(sigma.Has(&AirErrors::surface_range));
  EXPECT_THAT(survey.output.classes, ElementsAre(40));
  EXPECT_EQ(survey.output.coverage, "p95");
  EXPECT_EQ(survey.output.s44_order, "1b");
  EXPECT_EQ(survey.output.details, true);
}

TEST(SurveySections, MayEachBeAbsentOrEmpty) {
  for (const char* text :
       {"", "[sensor]\n[trajectory]\n[surface]\n[sea]\n[water]\n[datum]\n[extra]\n[sigma]\n[output]\n"}) {
    const SurveySettings survey = Survey(text);
    ForEachSection([&](const char* name, const auto& keys, const auto& section) {
      EXPECT_FALSE(IsAnyGiven(keys, section(survey))) << name;
    });
    EXPECT_FALSE(survey.sigma.any());
  }
}

TEST(SurveySections, FindFilesFromTheFolderOfTheSurvey) {
  EXPECT_EQ(Survey("[sensor]\nname = 'mine.toml'\n").sensor.name, "/data/mine.toml");
  EXPECT_EQ(Survey("[sensor]\nname = 'sensors/mine'\n").sensor.name, "/data/sensors/mine");
  EXPECT_EQ(Survey("[sensor]\nname = '/x/mine.toml'\n").sensor.name, "/x/mine.toml");
  EXPECT_EQ(Survey("[sensor]\nname = 'mine'\n").sensor.name, "mine");
  EXPECT_EQ(Survey("[surface]\nlevel = 'level.csv'\n").surface.level, Level("/data/level.csv"));
}

TEST(SurveySections, TakeWholeNumbersAsNumbers) {
  EXPECT_THAT(Survey("[sensor]\nlever_arm = [1, 2.5, -3]\n").sensor.lever_arm.value(), ElementsAre(1, 2.5, -3));
  EXPECT_EQ(Survey("[sigma]\nscan = 1\n").sigma.values.scan, 1);
  EXPECT_EQ(Survey("[surface]\nlevel = -23\nlocated = 'level'\n").surface.level, Level(-23.0));
}

// What stands in the file, how the message begins and what it says. key_test.cc has wrong values of each key.
struct WrongKey {
  std::string text, begins, says;
};

TEST(SurveySections, RefuseWrongKeysAndContradictionsWithOneClearMessage) {
  for (const WrongKey& wrong :
       {WrongKey{"[sensor]\nlever_arm = [0.3, '1', 0.5]\n", "line 2: 'sensor.lever_arm' has '1'", "3 numbers"},
        WrongKey{"[sensor]\nscan = 0.02\n", "line 2: 'sensor.scan' is no key of a survey file",
                 "there are channel, lever_arm, name"},
        WrongKey{"sensor = 'riegl-vq-880-g'\n", "line 1: 'sensor' is 'riegl-vq-880-g'", "begin it with [sensor]"},
        WrongKey{"[trajectory]\nfiles = ['a', 5]\n", "line 2: 'trajectory.files' has 5", "path"},
        WrongKey{"[trajectory]\nfiles = [\n'a',\n'a']\n", "line 4: 'trajectory.files' has 'a' twice", "once"},
        WrongKey{"[trajectory]\nfrom_returns = true\nfiles = ['a']\n",
                 "line 3: 'trajectory.files' contradicts from_returns", "give one of them"},
        WrongKey{"[trajectory]\nerrors = ['a']\nfrom_returns = true\n",
                 "line 2: 'trajectory.errors' contradicts from_returns", "give one of them"},
        WrongKey{"[trajectory]\nfile = ['a']\n", "line 2: 'trajectory.file' is no key", "did you mean files?"},
        WrongKey{"[surface]\nclasses = [41.0]\n", "line 2: 'surface.classes' has 41.0", "from 0 to 255"},
        WrongKey{"[surface]\nclasses = [41, 9, 41]\n", "line 2: 'surface.classes' has 41 twice", "once"},
        WrongKey{"[surface]\nlocated = 'pulse'\nlevel = 3\n", "line 3: 'surface.level' contradicts located",
                 "give one of them"},
        WrongKey{"[surface]\nlevel = 'level.csv'\nlocated = 'local'\n", "line 2: 'surface.level' contradicts located",
                 "\"local\""},
        WrongKey{"[water]\nbias = 'corrected'\n", "line 2: 'water.bias' is 'corrected'", "did you mean \"correct\"?"},
        WrongKey{"[datum]\nmcu = 0.1\nconfidence = '1sigma'\nsigma = 0.1\n",
                 "line 2: 'datum.mcu' is given beside sigma", "count twice"},
        WrongKey{"[datum]\nmcu = 0.1\n", "line 2: 'datum.mcu' has no confidence", "\"95%\""},
        WrongKey{"[datum]\nsigma = 0.1\nconfidence = '95%'\n", "line 3: 'datum.confidence' contradicts sigma", "mcu"},
        WrongKey{"[datum]\nmcu = 11.8\n", "line 2: 'datum.mcu' is 11.8 (expected 0.001 to 2 m)", "give it in m"},
        WrongKey{"[datum]\nsigma = 8\nsigma_95 = 5\n", "line 3: 'datum.sigma_95' is no key", "sigma"},
        WrongKey{"[output]\ndetails = 'true'\n", "line 2: 'output.details' is 'true'", "without quotes"},
        WrongKey{"[outputs]\n", "line 1: 'outputs' is no key of a survey file", "did you mean output?"}}) {
    const std::string error = ErrorOf(wrong.text);
    EXPECT_THAT(error, StartsWith(wrong.begins));
    EXPECT_THAT(error, HasSubstr(wrong.says));
    EXPECT_THAT(error, HasSubstr("; "));
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
}

TEST(SurveySections, GiveTheDatumAtItsConfidence) {
  const auto sigma = [](const std::string& datum) { return Survey("[datum]\n" + datum).datum.standard_deviation(); };
  EXPECT_EQ(sigma(""), std::nullopt);
  EXPECT_EQ(sigma("sigma = 0\n"), 0);
  EXPECT_EQ(sigma("mcu = 0.118\nconfidence = '1sigma'\n"), 0.118);
  EXPECT_NEAR(sigma("mcu = 0.2\nconfidence = '95%'\n").value(), 0.2 / 1.959963984540054, 1e-15);
  SurveySettings flags;
  flags.datum.sigma = 0.3;
  const SurveySettings both = Merge(flags, Survey("[datum]\nmcu = 0.2\nconfidence = '95%'\nregion = 'x'\n"));
  EXPECT_EQ(both.datum.standard_deviation(), 0.3);
  EXPECT_EQ(both.datum.region, std::nullopt);
}

TEST(SurveySections, TakeEachSourceOfErrorUpToItsEnd) {
  for (const ErrorSource& source : kErrorSources) {
    for (const double end : {0.0, source.greatest}) {
      const std::string number = std::to_string(end);
      const std::string value = source.size() == 1 ? number : "[" + number + ", " + number + ", " + number + "]";
      const config::StatedErrors sigma = Survey("[sigma]\n" + std::string(source.name) + " = " + value).sigma;
      EXPECT_THAT(source.In(sigma.values), ::testing::Each(end)) << source.name;
      EXPECT_EQ(std::ranges::count(sigma.stated, true), 1) << source.name;
    }
  }
}

// Roll and pitch of the best systems are known to 0.0025 degrees, 4.4e-5 rad.
TEST(SurveySections, RefuseAnglesInRadians) {
  for (const char* key : {"attitude", "boresight"}) {
    const std::string error = ErrorOf("[sigma]\n" + std::string(key) + " = [0.1, 4.4e-5, 0.1]\n");
    EXPECT_THAT(error, StartsWith("line 2: 'sigma." + std::string(key) + "' "));
    EXPECT_THAT(error, HasSubstr("looks like radians); give it in degree"));
    EXPECT_TRUE(ParseSurvey("[sigma]\n" + std::string(key) + " = [0.0025, 0, 0.0025]\n", "").ok());
  }
  EXPECT_THAT(ErrorOf("[sigma]\nscan = 1.7e-5\n"), HasSubstr("looks like radians"));
  EXPECT_TRUE(ParseSurvey("[sigma]\nscan = 0.001\ntime = 1e-7\nindex = 1e-6\n", "").ok());
}

TEST(SurveySections, LeaveOutTheColumnOfWaterWhereTheySaySo) {
  EXPECT_TRUE(Survey("[water]\ncolumn = 'none'\n").water.without_column());
  EXPECT_FALSE(Survey("[water]\nkd = 0.1\n").water.without_column());
}

}  // namespace
}  // namespace albtpu::config
