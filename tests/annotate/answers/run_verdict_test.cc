#include "annotate/answers/run_verdict.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "annotate/answers/answer_counts.h"
#include "annotate/answers/batch.h"
#include "annotate/answers/uncertainty_summary.h"
#include "service/client/local_source.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu::annotate {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;
using ::testing::Not;

CauseContext Context() {
  CauseContext context;
  context.axes = {{{2, 15, 2}, {1e3, 1e5, 2}, {0, 25, 2}, {0, 90, 2}, {0.1, 5, 2}, {0, 60, 2}}};
  context.footprint_from_beam = false;
  return context;
}

// As a summary states the answers of a file.
AnswerTally Answers(int interpolated, int footprint_above, double min_depth = 1, double footprint = 60) {
  Json json = {{"outcomes", {{"INTERPOLATED", interpolated}}}};
  if (interpolated > 0) json["depth"] = {{"least", min_depth}, {"greatest", 50.0}};
  if (footprint_above > 0) {
    json["outcomes"]["OUT_OF_DOMAIN:footprint:above"] = footprint_above;
    json["outside"]["OUT_OF_DOMAIN:footprint:above"] = {
        {"least", footprint}, {"median", footprint}, {"greatest", footprint}};
  }
  return AnswerTally::FromJson(Json::parse(json.dump()));
}

std::string Message(const RunVerdict& verdict) { return std::string(verdict.status().message()); }

TEST(RunVerdict, IsGoodWhereHalfOfThePulsesGotANumber) {
  RunVerdict verdict(Context(), "pulse");
  EXPECT_EQ(verdict.Add("a.csv", Answers(50, 50)), "");
  EXPECT_TRUE(verdict.status().ok());
}

TEST(RunVerdict, FailsWhereFewerGotANumberAndNamesTheCause) {
  RunVerdict verdict(Context(), "pulse");
  EXPECT_EQ(verdict.Add("a.csv", Answers(49, 51)),
            "a.csv: only 49 of 100 pulses got a number (51 OUT_OF_DOMAIN:footprint:above: footprint 60 m is "
            "above 5 m, "
            "the last node of the table); is the footprint in cm? give the footprint in m");
  EXPECT_TRUE(absl::IsFailedPrecondition(verdict.status()));
  EXPECT_THAT(Message(verdict), HasSubstr("a.csv: only 49 of 100 pulses"));
}

TEST(RunVerdict, SaysFirstThatNoneGotANumber) {
  RunVerdict verdict(Context(), "pulse");
  EXPECT_THAT(verdict.Add("a.csv", Answers(0, 7)), HasSubstr("a.csv: no pulse got a number (7 OUT"));
}

TEST(RunVerdict, IsOverAllFilesTogetherAndNamesEachBadOne) {
  RunVerdict verdict(Context(), "pulse");
  EXPECT_EQ(verdict.Add("a.csv", Answers(10, 0)), "");
  EXPECT_THAT(verdict.Add("b.csv", Answers(1, 8)), HasSubstr("b.csv: only 1 of 9 pulses"));
  EXPECT_TRUE(verdict.status().ok());
  EXPECT_THAT(verdict.Add("c.csv", Answers(0, 9, 0, 70)), HasSubstr("c.csv: no pulse"));
  EXPECT_THAT(Message(verdict),
              AllOf(HasSubstr("in all 3 files: only 11 of 28 pulses"), HasSubstr("footprint 60 to 70 m is above 5 m")));
}

TEST(RunVerdict, IsGoodWithoutFilesOrPulses) {
  RunVerdict verdict(Context(), "pulse");
  EXPECT_TRUE(verdict.status().ok());
  EXPECT_EQ(verdict.Add("empty.csv", Answers(0, 0)), "");
  EXPECT_TRUE(verdict.status().ok());
}

TEST(RunVerdict, TakesAnyJsonForASummary) {
  RunVerdict verdict(Context(), "pulse");
  for (const char* text : {"null", "3", "[]", R"({"outcomes": 3})", R"({"outcomes": {"INTERPOLATED": "x"}})",
                           R"({"outcomes": {"INTERPOLATED": -1}, "depth": []})",
                           R"({"outcomes": {"INVALID": 0}, "outside": {"INVALID": 1}})"})
    EXPECT_EQ(verdict.Add("a.csv", AnswerTally::FromJson(Json::parse(text))), "") << text;
  EXPECT_THAT(verdict.Add("a.csv", AnswerTally::FromJson(
                                       Json::parse(R"({"outcomes": {"NEW": 3}, "outside": {"NEW": {"least": "x"}}})"))),
              HasSubstr("3 NEW"));
}

TEST(RunVerdict, FailsWhereTheOtherSignOfTheWaterLevelExplainsThatNoPulseIsShallow) {
  CauseContext context = Context();
  context.water_level = 23;
  RunVerdict verdict(context, "pulse");
  verdict.Add("a.csv", Answers(10, 0, 46.5));
  EXPECT_THAT(Message(verdict), AllOf(HasSubstr("a.csv: no pulse is shallower than 20 m"),
                                      HasSubstr("sign of --water-level wrong? corrected, the least depth would "
                                                "be 0.5 m")));
  EXPECT_EQ(verdict.DeepNote(), "");
  // The other sign would put the sea 16 m below the shallowest bottom, or change nothing.
  for (const double level : {31.0, 5.0, -23.0}) {
    context.water_level = level;
    RunVerdict deep(context, "pulse");
    deep.Add("a.csv", Answers(10, 0, 46.5));
    EXPECT_TRUE(deep.status().ok()) << level;
    EXPECT_NE(deep.DeepNote(), "") << level;
  }
}

TEST(RunVerdict, NotesThatNoPulseIsShallow) {
  RunVerdict verdict(Context(), "pulse");
  EXPECT_EQ(verdict.DeepNote(), "");
  verdict.Add("a.csv", Answers(10, 0, 31.25));
  EXPECT_EQ(verdict.DeepNote(),
            "no pulse is shallower than 20 m (the least depth is 31.2 m); unless the survey is that deep, "
            "check the "
            "water level and its vertical datum");
  verdict.Add("b.csv", Answers(10, 0, 19.9));
  EXPECT_EQ(verdict.DeepNote(), "");
}

// A survey whose pulses are all inside the table: mistakes in its inputs are made on purpose.
class LikelyCauseTest : public ::testing::Test {
 protected:
  LikelyCauseTest() {
    pulses_.size = 3;
    pulses_[AxisId::kWindSpeed] = {6};
    pulses_[AxisId::kFetch] = {3e4f};
    pulses_[AxisId::kIncidence] = {18, 19, 20};
    pulses_[AxisId::kFootprint] = {0.6f};
    pulses_[AxisId::kDepth] = {2, 8, 19};
    context_.axes = source_.table().axes;
    context_.footprint_from_beam = false;
  }

  AnswerTally Tally() {
    AnswerSelection selection;
    UncertaintySummary::Select(selection);
    AnswerBatch answers;
    EXPECT_TRUE(AnswerPulses(source_, {}, pulses_, selection, answers).ok());
    summary_.Add(pulses_, answers);
    return summary_.Tally();
  }

  // "WHY; SUGGESTION", or empty. Begins a new summary.
  std::string Cause() {
    const std::optional<LikelyCause> cause = FindLikelyCause(Tally(), context_);
    summary_ = UncertaintySummary{AnswerStyle{}};
    return cause.has_value() ? cause->why + "; " + cause->suggestion : "";
  }

  // The depths of points at heights z [m] under a water level; those above it have no pulse.
  void SetHeights(const std::vector<float>& heights, double water_level) {
    context_.water_level = water_level;
    pulses_[AxisId::kDepth].clear();
    for (const float height : heights) {
      const auto depth = static_cast<float>(water_level - height);
      if (depth < 0)
        summary_.AddAboveWater(depth);
      else
        pulses_[AxisId::kDepth].push_back(depth);
    }
    pulses_.size = pulses_[AxisId::kDepth].size();
    pulses_[AxisId::kIncidence] = {18};
    if (pulses_.size == 0) pulses_[AxisId::kDepth] = {0};
  }

  client::LocalSource source_{"", albtpu::testing::SyntheticTable()};
  PulseBatch pulses_{.size = 0, .axis = {}};
  UncertaintySummary summary_{AnswerStyle{}};
  CauseContext context_;
};

TEST_F(LikelyCauseTest, IsNoneWhereAllPulsesGetANumber) { EXPECT_EQ(Cause(), ""); }

TEST_F(LikelyCauseTest, NamesAFootprintInCentimetres) {
  pulses_[AxisId::kFootprint] = {60};
  EXPECT_EQ(Cause(),
            "footprint 60 m is above 2 m, the last node of the table; is the footprint in cm? give the "
            "footprint in m");
}

TEST_F(LikelyCauseTest, NamesAFootprintInMillimetres) {
  pulses_[AxisId::kFootprint] = {600};
  EXPECT_THAT(Cause(), AllOf(HasSubstr("in mm?"), Not(HasSubstr("in cm?"))));
}

TEST_F(LikelyCauseTest, NamesADivergenceInRadiansOrMicroradians) {
  context_.footprint_from_beam = true;
  pulses_[AxisId::kFootprint] = {static_cast<float>(FootprintAtIncidence(400, 1.5e-3, 20))};
  EXPECT_THAT(Cause(), AllOf(HasSubstr("is below 0.25 m, the first node"), HasSubstr("divergence in rad?"),
                             HasSubstr("give the altitude in m and the divergence in mrad, full angle")));
  pulses_[AxisId::kFootprint] = {static_cast<float>(FootprintAtIncidence(400, 1500, 20))};
  EXPECT_THAT(Cause(), AllOf(HasSubstr("divergence in urad?"), Not(HasSubstr("feet"))));
}

TEST_F(LikelyCauseTest, NamesAnAltitudeInFeet) {
  context_.footprint_from_beam = true;
  pulses_[AxisId::kFootprint] = {static_cast<float>(FootprintAtIncidence(400 / 0.3048, 2, 20))};
  EXPECT_THAT(Cause(), AllOf(HasSubstr("altitude in feet?"), Not(HasSubstr("urad"))));
}

TEST_F(LikelyCauseTest, AsksForBothWhereTheOriginOfTheFootprintIsNotKnown) {
  context_.footprint_from_beam.reset();
  pulses_[AxisId::kFootprint] = {600};
  EXPECT_THAT(Cause(), AllOf(HasSubstr("footprint in mm?"), HasSubstr("divergence in urad?")));
}

TEST_F(LikelyCauseTest, NamesAnIncidenceInRadians) {
  // Only where the table begins above nadir: elsewhere 0.3 is as good an incidence as 20.
  context_.axes[Index(AxisId::kIncidence)].first = 5;
  AnswerTally tally;
  tally.without_number["OUT_OF_DOMAIN:incidence:below"] = {3, AnswerTally::Spread{0.31, 0.33, 0.35}};
  EXPECT_EQ(FindLikelyCause(tally, context_)->suggestion,
            "is the incidence in rad? give the incidence in degrees from the vertical");
}

TEST_F(LikelyCauseTest, NamesTheFileOfWaterLevelsThatDoesNotCoverThePoints) {
  AnswerTally tally;
  tally.without_number[std::string(OutcomeName(NoPulse::kNoSurface))].count = 3;
  EXPECT_THAT(FindLikelyCause(tally, context_)->suggestion, HasSubstr("--water-classes"));
  context_.water_level_by_time = true;
  EXPECT_THAT(FindLikelyCause(tally, context_)->why, HasSubstr("the file of --water-level has no level"));
}

TEST_F(LikelyCauseTest, NamesAWindInKnots) {
  pulses_[AxisId::kWindSpeed] = {12};
  EXPECT_THAT(Cause(), AllOf(HasSubstr("wind_speed 12 m/s is above 10 m/s"), HasSubstr("in knots?")));
  pulses_[AxisId::kWindSpeed] = {36};
  EXPECT_THAT(Cause(), AllOf(HasSubstr("in km/h?"), Not(HasSubstr("knots"))));
}

TEST_F(LikelyCauseTest, NamesAFetchInKilometres) {
  pulses_[AxisId::kFetch] = {30};
  EXPECT_THAT(Cause(), HasSubstr("is the fetch in km? give the fetch in m"));
}

TEST_F(LikelyCauseTest, NamesDepthsThatAreNegativeDownwards) {
  pulses_[AxisId::kDepth] = {-2, -8, -19};
  EXPECT_THAT(Cause(), AllOf(HasSubstr("depth -19 to -2 m is below 0 m"), HasSubstr("negative downwards?")));
}

TEST_F(LikelyCauseTest, CallsWaterTooDeepUnlessTheDepthIsFarOutside) {
  pulses_[AxisId::kDepth] = {25, 30, 40};
  EXPECT_THAT(Cause(), AllOf(HasSubstr("too deep for this table"), Not(HasSubstr("in cm"))));
  pulses_[AxisId::kDepth] = {200, 800, 1900};
  EXPECT_THAT(Cause(), HasSubstr("is the depth in cm?"));
}

TEST_F(LikelyCauseTest, NamesAWaterLevelOfTheWrongSign) {
  // Water at 23.09 m, the bottom 2 to 8 m below it.
  SetHeights({15, 18, 21}, -23.09);
  EXPECT_THAT(Cause(), AllOf(HasSubstr("they lie 38.09 to 44.09 m above the water surface"),
                             HasSubstr("sign of --water-level wrong?"), HasSubstr("the median depth would be")));
}

TEST_F(LikelyCauseTest, NamesTheWrongSignWherePointsSeemTooDeep) {
  SetHeights({-31, -28, -25}, 23.09);
  EXPECT_THAT(Cause(), AllOf(HasSubstr("is above 20 m"), HasSubstr("sign of --water-level wrong?")));
}

TEST_F(LikelyCauseTest, NamesAWaterLevelInCentimetresOrFeet) {
  SetHeights({-31, -28, -25}, -2309);
  EXPECT_THAT(Cause(), HasSubstr("is --water-level in cm?"));
  SetHeights({-31, -28, -25}, -23.09 / 0.3048);
  EXPECT_THAT(Cause(), HasSubstr("is --water-level in feet?"));
  SetHeights({15, 18, 21}, 2309);
  EXPECT_THAT(Cause(), HasSubstr("is --water-level in cm?"));
}

TEST_F(LikelyCauseTest, AsksForTheDatumWhereNoMistakeExplainsTheDepths) {
  SetHeights({315, 318, 321}, 0);
  EXPECT_THAT(Cause(), HasSubstr("check --water-level and its vertical datum"));
  SetHeights({315, 318, 321}, 0);
  context_.water_level.reset();
  EXPECT_THAT(Cause(), HasSubstr("check the water surface and its vertical datum"));
}

TEST_F(LikelyCauseTest, ExplainsPointsWithoutAPulse) {
  pulses_.size = 0;
  summary_.Add(NoPulse::kNoSurface, 2);
  EXPECT_THAT(Cause(), HasSubstr("no water surface is known there; check --water-classes"));
  summary_.Add(NoPulse::kUncertainTrajectory, 3);
  EXPECT_THAT(Cause(), HasSubstr("give its --trajectory"));
  summary_.Add(NoPulse::kNoTrajectory, 4);
  EXPECT_THAT(Cause(), AllOf(HasSubstr("no position at their times"), HasSubstr("--trajectory-time")));
  summary_.Add(NoPulse::kNoSea, 5);
  EXPECT_THAT(Cause(), AllOf(HasSubstr("no record near their times"), HasSubstr("longest_gap")));
}

TEST_F(LikelyCauseTest, NamesCoordinatesThatAreNotNumbers) {
  pulses_[AxisId::kDepth] = {NAN, NAN, 1};
  EXPECT_EQ(Cause(), "a coordinate is not a finite number; correct the coordinates");
}

TEST_F(LikelyCauseTest, ExplainsTheMostFrequentOutcome) {
  pulses_[AxisId::kDepth] = {99, -8, -19};
  EXPECT_THAT(Cause(), HasSubstr("negative downwards?"));
}

TEST_F(LikelyCauseTest, ExplainsOutcomesOfSummariesThatStateNoCoordinates) {
  AnswerTally tally;
  tally.without_number["OUT_OF_DOMAIN:depth"] = {3, {}};
  EXPECT_THAT(FindLikelyCause(tally, context_)->why, HasSubstr("OUT_OF_DOMAIN:depth"));
}

}  // namespace
}  // namespace albtpu::annotate
