#include "survey/seas/told_sea.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "survey/exit_status.h"

namespace albtpu::client {
namespace {

using ::testing::HasSubstr;

ToldSea OneWave() {
  ToldSea sea;
  sea.waves.push_back({.significant_wave_height = 1, .peak_period = 6});
  return sea;
}

void ExpectUsageError(const absl::Status& status, const std::string& part) {
  EXPECT_TRUE(IsUsageError(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr(part));
  EXPECT_THAT(std::string(status.message()), HasSubstr("; "));
}

TEST(ToldSea, IsItsOwnDescription) {
  ToldSea sea = OneWave();
  EXPECT_EQ(sea.description().tail, TailRule::kRelax);
  EXPECT_FALSE(sea.description().wind_from.has_value());
  sea.wind_speed = 0;
  sea.wind_from = 90;
  sea.water_depth = 8;
  sea.tail_from = 0.5;
  const std::pair<const char*, TailRule> rules[] = {{"relax", TailRule::kRelax},
                                                    {"wind", TailRule::kWind},
                                                    {"level", TailRule::kLevel},
                                                    {"none", TailRule::kNone}};
  for (const auto& [name, rule] : rules) {
    sea.tail = name;
    EXPECT_EQ(sea.description().tail, rule);
  }
  EXPECT_EQ(sea.description().wind_speed_10m, 0);
  EXPECT_DOUBLE_EQ(sea.description().wind_from.value(), std::numbers::pi / 2);
  EXPECT_EQ(sea.description().water_depth, 8);
  EXPECT_EQ(sea.description().tail_from, 0.5);
}

TEST(ToldSea, RefusesWhatHasNoEffect) {
  const auto refuse = [](const auto& each, auto value, ToldSea sea) {
    sea.*each.field = value;
    ExpectUsageError(CheckSea(sea), std::string(each.flag) + " (" + std::string(each.key));
  };
  for (const auto& number : kSeaNumbers) {
    const bool of_waves = number.key == "water_depth" || number.key == "tail_from";
    const bool of_file = number.key == "longest_gap" || number.key == "anemometer_height";
    if (of_waves || of_file) refuse(number, 5.0, ToldSea());
    if (of_file) refuse(number, 5.0, OneWave());
    if (of_file) continue;
    ToldSea sea = OneWave();
    sea.*number.field = 5;
    EXPECT_TRUE(CheckSea(sea).ok()) << number.key;
  }
  for (const auto& text : kSeaTexts) {
    if (text.key == "file") continue;
    refuse(text, "relax", ToldSea());
    if (text.key != "tail") refuse(text, "2020-06-08T03:50Z", OneWave());
  }
  ToldSea sea;
  sea.wind_speed = 5;
  sea.wind_from = 250;
  EXPECT_TRUE(CheckSea(sea).ok()) << "a wind alone is for a table of winds";
}

// The waves of 2 s are 6.24 m long, of which Michell's limit takes 0.142. In 0.5 m of water they are 4.06 m long, and
// the limit is lower by tanh(k h).
TEST(ToldSea, RefusesWavesThatBreak) {
  ToldSea sea;
  sea.waves = {{.significant_wave_height = 0.88, .peak_period = 2}};
  EXPECT_TRUE(CheckSea(sea).ok());
  sea.waves[0].significant_wave_height = 0.89;
  ExpectUsageError(CheckSea(sea), "waves of 0.89 m and 2 s");
  sea.waves[0].significant_wave_height = 0.37;
  sea.water_depth = 0.5;
  EXPECT_TRUE(CheckSea(sea).ok());
  sea.waves[0].significant_wave_height = 0.38;
  ExpectUsageError(CheckSea(sea), "in water of 0.5 m");
}

TEST(FlagsAndSurveyFile, SayDifferentThingsAndTheFlagsCount) {
  for (const auto& number : kSeaNumbers) {
    ToldSea flags, of_file;
    flags.*number.field = 1;
    of_file.*number.field = 2;
    EXPECT_EQ(Together(flags, of_file).*number.field, 1) << number.key;
    EXPECT_EQ(Together({}, of_file).*number.field, 2) << number.key;
  }
  for (const auto& text : kSeaTexts) {
    ToldSea flags, of_file;
    flags.*text.field = "flag";
    of_file.*text.field = "file";
    EXPECT_EQ(Together(flags, of_file).*text.field, "flag") << text.key;
    EXPECT_EQ(Together({}, of_file).*text.field, "file") << text.key;
  }
}

TEST(FlagsAndSurveyFile, TellOtherWavesOfWhichTheFlagsCount) {
  ToldSea waves = OneWave(), buoy;
  buoy.file = "41010.data_spec";
  buoy.place = "41010";
  buoy.longest_gap = 9;
  buoy.wind_speed = 6;
  const ToldSea flags_have_waves = Together(waves, buoy);
  EXPECT_EQ(flags_have_waves.waves.size(), 1u);
  EXPECT_FALSE(flags_have_waves.file.has_value() || flags_have_waves.place.has_value() ||
               flags_have_waves.longest_gap.has_value());
  EXPECT_EQ(flags_have_waves.wind_speed, 6);
  const ToldSea flags_have_a_file = Together(buoy, waves);
  EXPECT_TRUE(flags_have_a_file.waves.empty());
  EXPECT_EQ(flags_have_a_file.place, "41010");
  EXPECT_TRUE(CheckSea(flags_have_a_file).ok());
}

TEST(Swell, IsHeightPeriodAndDirection) {
  const JonswapWaves swell = ParseSwell("1.1,9.5,295").value();
  EXPECT_EQ(swell.significant_wave_height, 1.1);
  EXPECT_EQ(swell.peak_period, 9.5);
  EXPECT_EQ(swell.gamma, kSwellGamma);
  EXPECT_EQ(swell.spread, kSwellSpread);
  EXPECT_DOUBLE_EQ(swell.travels_towards, 475 * std::numbers::pi / 180);
  EXPECT_DOUBLE_EQ(ParseSwell("1.1,9.5,295,30").value().spread.value(), std::numbers::pi / 6);
}

TEST(Swell, IsNoOtherText) {
  for (const char* text : {"", "1", "1,2", "1,9,295,18,5", "1,9,x", "1;9;295", "-1,9,295", "1,0.1,295",
                           "1,99,295", "1,9,500", "1,9,295,90", "1,9,nan", "1.1,9.5,"}) {
    const absl::Status status = ParseSwell(text).status();
    EXPECT_THAT(std::string(status.message()), HasSubstr("; give HS,TP,FROM or HS,TP,FROM,SPREAD")) << text;
  }
  EXPECT_THAT(std::string(ParseSwell("110,9,295").status().message()),
              HasSubstr("has the hs '110' (expected a number from 0 to 30 m)"));
}

TEST(ToldWaves, NameWhatIsMissingAsTheUserDoes) {
  ToldWaves told;
  told.hs = 1;
  EXPECT_EQ(ProblemOf(told, "--"), "--tp is missing; give a number from 0.5 to 40 s");
  told.tp = 6;
  EXPECT_EQ(ProblemOf(told, ""), "waves_from is missing; give a number from -360 to 360 degree");
  told.waves_from = 200;
  EXPECT_EQ(ProblemOf(told, ""), "");
}

TEST(ToldSea, StatesItsParameters) {
  ToldSea sea = OneWave();
  sea.waves[0].travels_towards = 3 * std::numbers::pi / 2;
  sea.tail = "level";
  EXPECT_EQ(Parameters(sea).dump(),
            R"({"file":null,"time":null,"place":null,"tail":"level","wind_speed":null,"wind_from":null,)"
            R"("water_depth":null,"tail_from":null,"longest_gap":null,"anemometer_height":null,)"
            R"("waves":[{"hs":1.0,"tp":6.0,"gamma":3.3,"waves_from":90.0,"spread":null}]})");
}

}  // namespace
}  // namespace albtpu::client
