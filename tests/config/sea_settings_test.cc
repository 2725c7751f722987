#include "config/sea_settings.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "config/survey_settings.h"
#include "formats/text/text.h"

namespace albtpu::config {
namespace {

using ::testing::HasSubstr;

SeaSettings OneWave() {
  SeaSettings sea;
  sea.waves.push_back({.significant_wave_height = 1, .peak_period = 6});
  return sea;
}

void ExpectUsageError(const absl::Status& status, const std::string& part) {
  EXPECT_TRUE(formats::IsUsageError(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr(part));
  EXPECT_THAT(std::string(status.message()), HasSubstr("; "));
}

TEST(SeaSettings, IsItsOwnDescription) {
  SeaSettings sea = OneWave();
  EXPECT_EQ(sea.description().tail, TailRule::kRelax);
  EXPECT_FALSE(sea.description().wind_from.has_value());
  sea.wind_speed = 0;
  sea.wind_from = 90;
  sea.water_depth = 8;
  sea.tail_from = 0.5;
  const std::pair<const char*, TailRule> rules[] = {
      {"relax", TailRule::kRelax}, {"wind", TailRule::kWind}, {"level", TailRule::kLevel}, {"none", TailRule::kNone}};
  for (const auto& [name, rule] : rules) {
    sea.tail = name;
    EXPECT_EQ(sea.description().tail, rule);
  }
  EXPECT_EQ(sea.description().wind_speed_10m, 0);
  EXPECT_DOUBLE_EQ(sea.description().wind_from.value(), std::numbers::pi / 2);
  EXPECT_EQ(sea.description().water_depth, 8);
  EXPECT_EQ(sea.description().tail_from, 0.5);
}

TEST(SeaSettings, RefusesTwoWaysToGiveTheWaves) {
  SeaSettings sea = OneWave();
  EXPECT_TRUE(CheckSea(sea).ok());
  sea.file = "41010.spec";
  ExpectUsageError(CheckSea(sea), "both say which waves there are");
}

TEST(SeaSettings, RefusesWhatHasNoEffect) {
  for (const Key<SeaSettings>& key : kSeaKeys) {
    const std::string name(key.declaration.key);
    const bool of_waves = name == "water_depth" || name == "tail_from" || name == "tail";
    const bool of_file = name == "longest_gap" || name == "anemometer_height" || name == "place" || name == "time";
    for (SeaSettings sea : {SeaSettings(), OneWave()}) {
      const bool no_effect = of_file || (of_waves && !sea.has_waves()) || (name == "fetch" && sea.has_waves());
      if (name == "file") continue;
      Put(Value(5.0), key, sea);
      Put(Value(std::string("relax")), key, sea);
      if (no_effect) {
        ExpectUsageError(CheckSea(sea),
                         std::string(key.declaration.flag) + " (" + name + " in a survey file) has no effect");
      } else {
        EXPECT_TRUE(CheckSea(sea).ok()) << name;
      }
    }
  }
}

// The waves of 2 s are 6.24 m long, of which Michell's limit takes 0.142. In 0.5 m of water they are 4.06 m long, and
// the limit is lower by tanh(k h).
TEST(SeaSettings, RefusesWavesThatBreak) {
  SeaSettings sea;
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

TEST(SeaSettings, RefusesATailInPlaceOfTheWaves) {
  SeaSettings sea;
  sea.waves = {{.significant_wave_height = 0.5, .peak_period = 4}};
  sea.tail_from = 0.26;
  EXPECT_TRUE(CheckSea(sea).ok());
  sea.tail_from = 0.25;
  ExpectUsageError(CheckSea(sea), "0.25 Hz is not above the peak of the waves of 4 s");
}

TEST(SeaSettings, RefusesATimeThatIsNone) {
  SeaSettings sea;
  sea.file = "41010.spec";
  sea.time = "2020-06-08";
  ExpectUsageError(CheckSea(sea), "'2020-06-08' is no time");
}

SeaSettings Merged(const SeaSettings& flags, const SeaSettings& file) {
  SurveySettings of_flags, of_file;
  of_flags.sea = flags;
  of_file.sea = file;
  return Merge(of_flags, of_file).sea;
}

TEST(FlagsAndSurveyFile, GiveOtherWavesOfWhichTheFlagsCount) {
  SeaSettings waves = OneWave(), buoy;
  buoy.file = "41010.data_spec";
  buoy.place = "41010";
  buoy.longest_gap = 9;
  buoy.wind_speed = 6;
  buoy.tail = "none";
  buoy.tail_from = 0.2;
  buoy.water_depth = 5;
  const SeaSettings flags_have_waves = Merged(waves, buoy);
  EXPECT_EQ(flags_have_waves.waves.size(), 1u);
  EXPECT_FALSE(flags_have_waves.file.has_value() || flags_have_waves.place.has_value() ||
               flags_have_waves.longest_gap.has_value());
  EXPECT_FALSE(flags_have_waves.tail.has_value() || flags_have_waves.tail_from.has_value());
  EXPECT_EQ(flags_have_waves.wind_speed, 6);
  EXPECT_EQ(flags_have_waves.water_depth, 5);
  const SeaSettings flags_have_a_file = Merged(buoy, waves);
  EXPECT_TRUE(flags_have_a_file.waves.empty());
  EXPECT_EQ(flags_have_a_file.place, "41010");
  EXPECT_TRUE(CheckSea(flags_have_a_file).ok());
}

TEST(FlagsAndSurveyFile, GiveWavesInPlaceOfAFetch) {
  SeaSettings wind;
  wind.fetch = 20000;
  EXPECT_FALSE(Merged(OneWave(), wind).fetch.has_value());
  EXPECT_EQ(Merged({}, wind).fetch, 20000);
}

TEST(FlagsAndSurveyFile, GiveATrajectoryEachAndThatOfTheFlagsCounts) {
  SurveySettings flags, file;
  file.trajectory.files = {"a"};
  file.trajectory.errors = {"b"};
  file.trajectory.time = "utc";
  EXPECT_EQ(Merge(flags, file).trajectory.errors.size(), 1u);
  flags.trajectory.from_returns = true;
  const TrajectorySettings merged = Merge(flags, file).trajectory;
  EXPECT_TRUE(merged.files.empty() && merged.errors.empty() && !merged.time.has_value());
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
  for (const char* text : {"", "1", "1,2", "1,9,295,18,5", "1,9,x", "1;9;295", "-1,9,295", "1,0.1,295", "1,99,295",
                           "1,9,500", "1,9,295,90", "1,9,nan", "1.1,9.5,"}) {
    const absl::Status status = ParseSwell(text).status();
    EXPECT_THAT(std::string(status.message()), HasSubstr("; give HS,TP,FROM or HS,TP,FROM,SPREAD")) << text;
  }
  EXPECT_THAT(std::string(ParseSwell("110,9,295").status().message()),
              HasSubstr("has the hs '110' (expected a number from 0 to 30 m)"));
}

TEST(WaveSettings, NameWhatIsMissingAsTheUserDoes) {
  WaveSettings waves;
  waves.hs = 1;
  EXPECT_EQ(ProblemOf(waves, true), "--tp is missing; give a number from 0.5 to 25 s");
  waves.tp = 6;
  EXPECT_EQ(ProblemOf(waves, false), "waves_from is missing; give a number from -360 to 360 degree");
  waves.waves_from = 200;
  EXPECT_EQ(ProblemOf(waves, false), "");
}

TEST(WaveSettings, OfFlagsComeBeforeSwell) {
  SeaSettings flags = OneWave();
  EXPECT_TRUE(CompleteWaves(flags).ok());
  EXPECT_EQ(flags.waves.size(), 1u);
  flags.wave_flags.hs = 0.5;
  ExpectUsageError(CompleteWaves(flags), "--tp is missing");
  flags.wave_flags.tp = 3;
  flags.wave_flags.waves_from = 0;
  EXPECT_TRUE(CompleteWaves(flags).ok());
  ASSERT_EQ(flags.waves.size(), 2u);
  EXPECT_EQ(flags.waves[0].significant_wave_height, 0.5);
}

TEST(SeaSettings, StatesItsParameters) {
  SeaSettings sea = OneWave();
  sea.waves[0].travels_towards = 3 * std::numbers::pi / 2;
  sea.tail = "level";
  EXPECT_EQ(Parameters(sea).dump(),
            R"({"file":null,"time":null,"place":null,"tail":"level","wind_speed":null,"wind_from":null,)"
            R"("water_depth":null,"tail_from":null,"longest_gap":null,"anemometer_height":null,)"
            R"("waves":[{"hs":1.0,"tp":6.0,"gamma":3.3,"waves_from":90.0,"spread":null}]})");
}

}  // namespace
}  // namespace albtpu::config
