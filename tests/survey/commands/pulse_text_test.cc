#include "survey/commands/pulse_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "service/client/local_source.h"
#include "survey/number_text.h"
#include "tests/survey/answers/test_sources.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu::client {
namespace {

using albtpu::testing::SyntheticTable;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

const Pulse kPulse = {.wind_speed = 5, .incidence = 12.5f, .azimuth = 30.0f, .footprint = 0.6f, .depth = 7};

class PulseTextTest : public ::testing::Test {
 protected:
  PulseAnswer Ask(const Pulse& pulse) {
    FixedCoordinates fixed = {pulse.wind_speed, {},         pulse.incidence, pulse.azimuth,
                              pulse.footprint,  pulse.depth};
    return AskPulse(fixed, style_, source_).value();
  }
  Json JsonOf(const Pulse& pulse) { return Json::parse(PulseJson(Ask(pulse), source_.table())); }
  std::string TextOf(const Pulse& pulse) { return PulseText(Ask(pulse), source_.table()); }

  LocalSource source_{"", SyntheticTable()};
  AnswerStyle style_;
};

TEST_F(PulseTextTest, HoldsTheCsvsNamesAndTheTable) {
  const Json json = JsonOf(kPulse);
  const PulseUncertainty answer = albtpu::testing::QueryPulse(source_, kPulse);
  for (const Quantity quantity : kQuantities) {
    EXPECT_EQ(json.at(std::string(Describe(quantity).name)).get<float>(), answer[quantity]);
  }
  EXPECT_EQ(json.at("outcome"), "INTERPOLATED");
  EXPECT_EQ(json.at("footprint").get<float>(), 0.6f);
  EXPECT_TRUE(json.at("fetch").is_null());
  EXPECT_EQ(json.at("azimuth_absent"), false);
  EXPECT_EQ(json.at("table"), "synthetic");
  EXPECT_EQ(json.at("digest"), source_.table().digest);
  EXPECT_EQ(json.at("coverage"), "2sigma");
  EXPECT_FALSE(json.contains("thu_standard_error"));
}

TEST_F(PulseTextTest, PrintsNumbersWithTheDigitsOfTheCsv) {
  const PulseUncertainty answer = albtpu::testing::QueryPulse(source_, kPulse);
  EXPECT_THAT(PulseJson(Ask(kPulse), source_.table()),
              HasSubstr("\"thu\": " + FormatFloat(answer[Quantity::kThu]) + ",\n"));
}

TEST_F(PulseTextTest, IsNullWhereThereIsNoNumber) {
  Pulse pulse = kPulse;
  pulse.depth = 99;
  pulse.azimuth.reset();
  style_ = {.coverage = Coverage::kP95, .s44_order = S44Order::k2, .standard_errors = true};
  const Json json = JsonOf(pulse);
  for (const char* name :
       {"azimuth", "thu", "bias_vertical", "tvu_standard_error", "s44_best_order", "s44_remaining_tvu"}) {
    EXPECT_TRUE(json.at(name).is_null()) << name;
  }
  EXPECT_EQ(json.at("outcome"), "OUT_OF_DOMAIN:depth");
  EXPECT_EQ(json.at("coverage"), "p95");
}

TEST_F(PulseTextTest, TellsPeopleTheCoverageTheTableAndEveryOrder) {
  const std::string text = TextOf(kPulse);
  for (const char* part : {"synthetic 1", "m, 2 sigma", "degree, 2 sigma", "fully developed sea", "exclusive",
                           "special", "1a", "1b", "IHO S-44 edition", "all at 95 %"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_THAT(text, HasSubstr(source_.table().digest));
  style_ = {.coverage = Coverage::kP95, .s44_order = S44Order::k1b, .standard_errors = true};
  EXPECT_THAT(TextOf(kPulse), HasSubstr("m, 95 %\n"));
  EXPECT_THAT(TextOf(kPulse), HasSubstr(" +- "));
  EXPECT_THAT(TextOf(kPulse), Not(HasSubstr("special")));
}

TEST_F(PulseTextTest, TellsPeopleTheRangeThatThereIs) {
  Pulse pulse = kPulse;
  pulse.depth = 99;
  EXPECT_THAT(TextOf(pulse),
              HasSubstr("OUT_OF_DOMAIN:depth\nno number is invented: the table reaches depth from 0 to "
                        "20 m\n"));
}

TEST_F(PulseTextTest, TellsPeopleWhatTheTableDoesNotHold) {
  source_ = LocalSource("", SyntheticTable({.published = true}));
  EXPECT_THAT(TextOf(kPulse), HasSubstr("bias_vertical            not in this table"));
}

}  // namespace
}  // namespace albtpu::client
