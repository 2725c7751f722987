#include "annotate/answers/run_verdict.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace albtpu::annotate {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

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

}  // namespace
}  // namespace albtpu::annotate
