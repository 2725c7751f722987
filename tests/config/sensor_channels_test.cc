#include "config/sensor_channels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/survey_settings.h"
#include "tests/config/parsed_survey.h"

namespace albtpu::config {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr char kTwo[] = R"([sensor]
lever_arm = [1, 2, 3]
[[sensor.channel]]
scanner_channels = [0, 2]
name = "leica-chiroptera-5"
divergence = 4.75
[[sensor.channel]]
scanner_channels = [1]
user_data = [5]
name = "deep.toml"
lever_arm = [0.1, 0.2, 0.3]
[sensor.channel.sigma]
scan = 0.01
[sigma]
scan = 0.02
bottom_range = 0.03
)";

TEST(SensorChannels, AreSurveysOfOneSensorEach) {
  const SurveySettings survey = Survey(kTwo);
  ASSERT_EQ(survey.sensor.channels.size(), 2u);
  EXPECT_TRUE(survey.wants_total());
  const ChannelSettings &first = survey.sensor.channels[0], &second = survey.sensor.channels[1];
  EXPECT_THAT(first.scanner_channels, ElementsAre(0, 2));
  EXPECT_EQ(first.label(), "scanner channel 0, 2");
  EXPECT_EQ(second.label(), "scanner channel 1 with user data 5");
  const SurveySettings of_first = survey.OfChannel(first), of_second = survey.OfChannel(second);
  EXPECT_EQ(of_first.sensor.name, "leica-chiroptera-5");
  EXPECT_EQ(of_second.sensor.name, "/data/deep.toml");
  EXPECT_THAT(of_first.sensor.lever_arm.value(), ElementsAre(1, 2, 3));
  EXPECT_THAT(of_second.sensor.lever_arm.value(), ElementsAre(0.1, 0.2, 0.3));
  EXPECT_TRUE(of_first.sensor.channels.empty());
  EXPECT_EQ(of_first.sigma.values.scan, 0.02);
  EXPECT_EQ(of_second.sigma.values.scan, 0.01);
  EXPECT_EQ(of_second.sigma.values.bottom_range, 0.03);
}

TEST(SensorChannels, GiveWayToASensorOfTheFlags) {
  SurveySettings flags;
  flags.sensor.name = "riegl-vq-880-g";
  const SurveySettings survey = Merge(flags, Survey(kTwo));
  EXPECT_TRUE(survey.sensor.channels.empty());
  EXPECT_EQ(survey.sensor.name, "riegl-vq-880-g");
}

TEST(SensorChannels, MapEachPointOnceAtMost) {
  const std::string begin = "[[sensor.channel]]\nname = 'a'\n", next = "\n" + begin;
  Survey(begin + "scanner_channels = [0]" + next + "scanner_channels = [1]");
  Survey(begin + "user_data = [0]\nscanner_channels = [1]" + next + "user_data = [1]");
  for (const char* second : {"scanner_channels = [1, 0]", "user_data = [4]", "scanner_channels = [0]\nuser_data = [4]"})
    EXPECT_THAT(ErrorOf(begin + "scanner_channels = [0]" + next + second), HasSubstr("map no point twice")) << second;
}

TEST(SensorChannels, AreRefusedWithOneClearMessage) {
  const std::string begin = "[[sensor.channel]]\nname = 'a'\n";
  EXPECT_THAT(ErrorOf("[[sensor.channel]]\nuser_data = [1]\n"), HasSubstr("name is missing"));
  EXPECT_THAT(ErrorOf(begin), HasSubstr("maps no points"));
  EXPECT_THAT(ErrorOf("[sensor]\nname = 'b'\n" + begin + "user_data = [1]\n"),
              StartsWith("line 2: 'sensor.name' contradicts [[sensor.channel]]"));
  EXPECT_THAT(ErrorOf(begin + "user_data = [1]\nfootprint = 1\naperture = 0.1\n"),
              StartsWith("line 4: 'sensor.channel.footprint' is given beside"));
  EXPECT_THAT(ErrorOf(begin + "user_data = [1]\n[sensor.channel.sigma]\nsurface_height = 0.1\n"),
              HasSubstr("is no key"));
  EXPECT_THAT(ErrorOf(begin + "user_data = [1]\nscaner_channels = [1]\n"), HasSubstr("did you mean scanner_channels?"));
}

}  // namespace
}  // namespace albtpu::config
