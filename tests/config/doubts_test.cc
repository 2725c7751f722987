#include "config/doubts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "absl/strings/str_cat.h"

namespace albtpu::config {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> DoubtsOf(const std::string& text) {
  const absl::StatusOr<SurveySettings> survey = ParseSurvey(text, "/data");
  EXPECT_TRUE(survey.ok()) << survey.status();
  return Doubts(*survey);
}

TEST(Doubts, AreOfStandardDeviationsInAnotherUnit) {
  EXPECT_THAT(
      DoubtsOf("[sigma]\nposition = [2, 2, 17]\nattitude = [0.3, 0.3, 1]\ntime = 0.02\nindex = 0.05\n"
               "bottom_range = 2.5\n"),
      ElementsAre("[sigma] position is 2, 2, 17 m, more than 1 m: is it a standard deviation in m, not in cm or "
                  "mm?",
                  "[sigma] attitude is 0.3, 0.3, 1 degree, more than 0.5 degree: is it a standard deviation in "
                  "degree, not in arc seconds or mrad?",
                  "[sigma] time is 0.02 s, more than 0.01 s: is it a standard deviation in s, not in ms or us?",
                  "[sigma] bottom_range is 2.5 m, more than 1 m: is it a standard deviation in m, not in cm or "
                  "mm?",
                  "[sigma] index is 0.05, more than 0.02: is it a standard deviation, not in units of 1e-6?"));
  EXPECT_THAT(DoubtsOf("[datum]\nsigma = 8\n[extra]\nhorizontal = 5\nvertical = 0.5\n"),
              ElementsAre("[datum] sigma is 8 m, more than 1 m: is it a standard deviation in m, not in cm or mm?",
                          "[extra] horizontal is 5 m, more than 1 m: is it a standard deviation in m, not in cm or "
                          "mm?"));
}

TEST(Doubts, AreOfTheChannelsOfASensor) {
  EXPECT_THAT(DoubtsOf("[[sensor.channel]]\nscanner_channels = [1]\nname = \"riegl-vq-880-g\"\n"
                       "[sensor.channel.sigma]\nbottom_range = 2.5\n"),
              ElementsAre("[sensor.channel.sigma] (scanner channel 1) bottom_range is 2.5 m, more than 1 m: is it a "
                          "standard deviation in m, not in cm or mm?"));
}

TEST(Doubts, AreNotOfUsualNumbers) {
  EXPECT_THAT(DoubtsOf(""), IsEmpty());
  std::string all = "[sigma]\n";
  for (const ErrorSource& source : kErrorSources)
    absl::StrAppend(&all, std::string(source.name), " = ", source.size() == 3 ? "[0.02, 0.3, 0.06]" : "0.01", "\n");
  EXPECT_THAT(DoubtsOf(all), IsEmpty());
  EXPECT_THAT(DoubtsOf("[datum]\nsigma = 1\n"), IsEmpty());
  EXPECT_THAT(DoubtsOf("[datum]\nmcu = 0.226\nconfidence = \"95%\"\n"), IsEmpty());
}

}  // namespace
}  // namespace albtpu::config
