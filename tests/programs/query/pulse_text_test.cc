#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "annotate/answers/uncertainty_summary.h"
#include "formats/text/text.h"
#include "programs/query/pulse_command.h"
#include "service/client/local_source.h"
#include "tests/annotate/answers/test_sources.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu::programs {
namespace {

using albtpu::testing::SyntheticTable;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

const Pulse kPulse = {.wind_speed = 5, .incidence = 12.5f, .azimuth = 30.0f, .footprint = 0.6f, .depth = 7};

class PulseTextTest : public ::testing::Test {
 protected:
  PulseAnswer Ask(const Pulse& pulse) {
    annotate::FixedCoordinates fixed = {pulse.wind_speed, {},         pulse.incidence, pulse.azimuth,
                                        pulse.footprint,  pulse.depth};
    return AskPulse(fixed, style_, source_).value();
  }
  Json JsonOf(const Pulse& pulse) { return Json::parse(PulseJson(Ask(pulse), source_.table(), Json::object())); }
  std::string TextOf(const Pulse& pulse) { return PulseText(Ask(pulse), source_.table()); }

  client::LocalSource source_{"", SyntheticTable()};
  annotate::AnswerStyle style_;
};

TEST_F(PulseTextTest, HasTheColumnNamesOfCsvAndTheTable) {
  const Json json = JsonOf(kPulse);
  const PulseUncertainty answer = albtpu::testing::QueryPulse(source_, kPulse);
  for (const Quantity quantity : kQuantities)
    EXPECT_EQ(json.at(std::string(Describe(quantity).name)).get<float>(), answer[quantity]);
  EXPECT_EQ(json.at("outcome"), "INTERPOLATED");
  EXPECT_EQ(json.at("footprint").get<float>(), 0.6f);
  EXPECT_TRUE(json.at("fetch").is_null());
  EXPECT_EQ(json.at("azimuth_absent"), false);
  EXPECT_EQ(json.at("table"), "synthetic");
  EXPECT_EQ(json.at("digest"), source_.table().digest);
  EXPECT_EQ(json.at("coverage"), "2sigma");
  EXPECT_FALSE(json.contains("thu_standard_error"));
}

TEST_F(PulseTextTest, PrintsNumbersWithTheDigitsOfCsv) {
  const PulseUncertainty answer = albtpu::testing::QueryPulse(source_, kPulse);
  EXPECT_THAT(PulseJson(Ask(kPulse), source_.table(), Json::object()),
              HasSubstr("\"thu\": " + formats::FormatFloat(answer[Quantity::kThu]) + ",\n"));
}

TEST_F(PulseTextTest, IsNullWhereThereIsNoNumber) {
  Pulse pulse = kPulse;
  pulse.depth = 99;
  pulse.azimuth.reset();
  style_ = {.coverage = Coverage::kP95, .s44_order = S44Order::k2, .standard_errors = true};
  const Json json = JsonOf(pulse);
  for (const char* name :
       {"azimuth", "thu", "bias_vertical", "tvu_standard_error", "s44_best_order", "s44_remaining_tvu"})
    EXPECT_TRUE(json.at(name).is_null()) << name;
  EXPECT_EQ(json.at("outcome"), "OUT_OF_DOMAIN:depth:above");
  EXPECT_EQ(json.at("coverage"), "p95");
}

TEST_F(PulseTextTest, StatesTheCoverageTheTableAndEveryOrder) {
  const std::string text = TextOf(kPulse);
  for (const char* part : {"synthetic 1", "m, 2 sigma", "degree, 2 sigma", "fully developed sea", "exclusive",
                           "special", "1a", "1b", "IHO S-44 edition", "all at 95 %"})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_THAT(text, HasSubstr(source_.table().digest));
  style_ = {.coverage = Coverage::kP95, .s44_order = S44Order::k1b, .standard_errors = true};
  EXPECT_THAT(TextOf(kPulse), HasSubstr("m, 95 %\n"));
  EXPECT_THAT(TextOf(kPulse), HasSubstr(" +- "));
  EXPECT_THAT(TextOf(kPulse), Not(HasSubstr("special")));
}

TEST_F(PulseTextTest, StatesTheRangeThatTheTableCovers) {
  Pulse pulse = kPulse;
  pulse.depth = 99;
  EXPECT_THAT(TextOf(pulse),
              HasSubstr("OUT_OF_DOMAIN:depth:above\nno number (the table covers depth from 0 to 20 m)\n"));
}

TEST_F(PulseTextTest, StatesWhatTheTableDoesNotHold) {
  source_ = client::LocalSource("", SyntheticTable({.published = true}));
  EXPECT_THAT(TextOf(kPulse), HasSubstr("bias_vertical            not in this table"));
}

// A table that knows what it errs by between its nodes.
client::TableSummary Checked() {
  client::TableSummary table = client::LocalSource("", SyntheticTable()).table();
  table.attributes["interpolation_error_thu"] = "0.002761, 0.0112, 0.0181217, 0.00155256, 299";
  table.attributes["interpolation_error_tvu"] = "0.56, 0.9, 1, 0.001, 40";
  return table;
}

TEST_F(PulseTextTest, StatesTheInterpolationErrorBesideTheStandardErrors) {
  for (const bool standard_errors : {false, true}) {
    style_.standard_errors = standard_errors;
    const std::string text = PulseText(Ask(kPulse), Checked());
    EXPECT_THAT(text, HasSubstr("\n  thu                    0.28 % rms, 1.1 % at the 99th percentile\n"));
    EXPECT_THAT(text, HasSubstr("\n  tvu                    56 % rms, 90 % at the 99th percentile\n"));
  }
}

TEST_F(PulseTextTest, AddsTheInterpolationErrorToJsonAsFractions) {
  const Json json = Json::parse(PulseJson(Ask(kPulse), Checked(), Json::object()));
  EXPECT_EQ(json.at("thu_interpolation_error_rms"), 0.002761);
  EXPECT_EQ(json.at("thu_interpolation_error_percentile_99"), 0.0112);
  EXPECT_TRUE(json.at("refraction_along_wind_interpolation_error_rms").is_null());
  EXPECT_FALSE(json.contains("bias_vertical_interpolation_error_rms"));
}

TEST_F(PulseTextTest, SaysThatTheInterpolationErrorIsNotKnown) {
  EXPECT_THAT(TextOf(kPulse), HasSubstr("interpolation error      not known (the table does not state it)\n"));
  EXPECT_TRUE(JsonOf(kPulse).at("thu_interpolation_error_rms").is_null());
}

TEST(InterpolationErrors, AreNotReadFromAnythingElse) {
  client::TableSummary table;
  for (const char* text :
       {"", "1", "0.1, 0.2, 0.3, 0.4", "0.1, 0.2, 0.3, 0.4, 5, 6", "nan, 0.2, 0.3, 0.4, 5", "0, 0, 0, 0, 0", "far"}) {
    table.attributes["interpolation_error_thu"] = text;
    EXPECT_TRUE(annotate::InterpolationErrors(table).empty()) << text;
  }
}

TEST(InterpolationErrors, FitIntoOneLine) {
  EXPECT_EQ(annotate::InterpolationErrorNote(Checked()),
            "interpolation error, relative, at random pulses all over the table: thu 0.28 % rms, 1.1 % at the 99th "
            "percentile; tvu 56 % rms, 90 % at the 99th percentile");
  EXPECT_EQ(annotate::InterpolationErrorNote({}), "interpolation error: not known (the table does not state it)");
}

}  // namespace
}  // namespace albtpu::programs
