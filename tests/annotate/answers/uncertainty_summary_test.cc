#include "annotate/answers/uncertainty_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

namespace albtpu::annotate {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

// Pulses at these depths, with a THU of 1/10 and a TVU of 1/100 of the depth. Negative depths are out of domain.
struct AnsweredPulses {
  explicit AnsweredPulses(const std::vector<float>& depths, std::uint8_t best_order = 1) {
    pulses.size = depths.size();
    pulses[AxisId::kDepth] = depths;
    AnswerSelection selection{.quantities = {}, .standard_errors = true};
    UncertaintySummary::Select(selection);
    answers.Resize(depths.size(), selection);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const bool inside = depths[i] >= 0;
      answers.outcomes[i] = inside ? 1 : 2;
      answers.outcome_axes[i] = inside ? 0 : Index(AxisId::kDepth) + 1;
      answers.sides[i] = inside ? 0 : 1;
      answers.values[Index(Quantity::kThu)][i] = inside ? depths[i] / 10 : NAN;
      answers.values[Index(Quantity::kTvu)][i] = inside ? depths[i] / 100 : NAN;
      answers.standard_errors[Index(Quantity::kThu)][i] = 0.5f;
      answers.standard_errors[Index(Quantity::kTvu)][i] = NAN;
      answers.best_s44_orders[i] = inside ? best_order : 0;
    }
  }
  PulseBatch pulses;
  AnswerBatch answers;
};

TEST(UncertaintySummary, SortsPulsesIntoDepthBands) {
  const AnsweredPulses some({0, 0.125, 0.25, 7, 7.5, 60, -1});
  UncertaintySummary summary{AnswerStyle{}};
  summary.Add(some.pulses, some.answers);
  const Json json = summary.Json();
  EXPECT_EQ(json["pulses"], 7);
  EXPECT_EQ(json["outcomes"], Json({{"INTERPOLATED", 6}, {"OUT_OF_DOMAIN:depth:below", 1}}));
  EXPECT_EQ(json["without_azimuth"], 7);
  EXPECT_EQ(json["depth"], Json({{"least", 0.0}, {"greatest", 60.0}}));
  ASSERT_EQ(json["depth_bands"].size(), 4u);
  EXPECT_EQ(json["depth_bands"][0]["pulses"], 2);
  const Json& band = json["depth_bands"][2];
  EXPECT_EQ(band["from"], 5.0);
  EXPECT_EQ(band["to"], 10.0);
  EXPECT_EQ(band["thu"]["least"], 0.699999988);
  EXPECT_EQ(band["thu"]["greatest"], 0.75);
  EXPECT_NEAR(band["thu"]["mean"].get<double>(), 0.725, 1e-6);
  EXPECT_TRUE(json["depth_bands"][3]["to"].is_null());
}

TEST(UncertaintySummary, CountsPulsesByTheStrictestOpenOrder) {
  UncertaintySummary summary{AnswerStyle{}};
  for (std::uint8_t order = 0; order <= 5; ++order) {
    const AnsweredPulses one({3}, order);
    summary.Add(one.pulses, one.answers);
  }
  const Json json = summary.Json();
  EXPECT_EQ(json["s44_best_order"],
            Json({{"exclusive", 1}, {"special", 1}, {"1a", 1}, {"1b", 1}, {"2", 1}, {"none", 1}}));
  EXPECT_EQ(json["depth_bands"][0]["s44_left_open"],
            Json({{"exclusive", 1}, {"special", 2}, {"1a", 3}, {"1b", 4}, {"2", 5}}));
  EXPECT_THAT(summary.Text(), HasSubstr("66.7 %"));  // Order 1b is open for 4 of 6.
}

TEST(UncertaintySummary, MergesToTheSameSummaryAsOneBatch) {
  const AnsweredPulses first({1, 2, 4}), second({3, -1}), both({1, 2, 4, 3, -1});
  UncertaintySummary a{AnswerStyle{}}, b{AnswerStyle{}}, all{AnswerStyle{}};
  a.Add(first.pulses, first.answers);
  b.Add(second.pulses, second.answers);
  a.Merge(b);
  a.Merge(UncertaintySummary{AnswerStyle{}});
  all.Add(both.pulses, both.answers);
  EXPECT_EQ(a.Text(), all.Text());
  EXPECT_EQ(a.Json()["outcomes"], all.Json()["outcomes"]);
  EXPECT_EQ(a.Json()["depth"], all.Json()["depth"]);
}

TEST(UncertaintySummary, IsNullWhereTheTableHasNoStandardErrors) {
  const AnsweredPulses some({1});
  UncertaintySummary summary{AnswerStyle{.coverage = {}, .s44_order = {}, .standard_errors = true}};
  summary.Add(some.pulses, some.answers);
  const Json json = Json::parse(summary.Json().dump());
  EXPECT_EQ(json["depth_bands"][0]["thu"]["mean_standard_error"], 0.5);
  EXPECT_TRUE(json["depth_bands"][0]["tvu"]["mean_standard_error"].is_null());
}

TEST(UncertaintySummary, OmitsDepthsWhenNoPulseIsInterpolated) {
  const AnsweredPulses none({-1});
  UncertaintySummary summary{AnswerStyle{}};
  summary.Add(none.pulses, none.answers);
  EXPECT_FALSE(summary.Json().contains("depth"));
  EXPECT_EQ(summary.Text().find('\n'), std::string::npos);
}

TEST(CoordinateSpread, IsExactWhereAllNumbersAreTheSame) {
  for (const float number : {60.0f, -0.3f, 0.0f, -0.0f, 1e30f, 1e-40f}) {
    CoordinateSpread spread;
    for (int i = 0; i < 5; ++i) spread.Add(number);
    EXPECT_EQ(spread.least(), number);
    EXPECT_EQ(spread.middle(), number);
    EXPECT_EQ(spread.greatest(), number);
    EXPECT_EQ(spread.count(), 5u);
  }
}

TEST(CoordinateSpread, FindsTheMedianWithinASixteenth) {
  std::mt19937 random(1);
  for (const double centre : {-30.0, -1.0, 0.002, 5.0, 700.0}) {
    std::normal_distribution<float> normal(static_cast<float>(centre), static_cast<float>(std::abs(centre) / 4));
    CoordinateSpread spread;
    std::vector<float> numbers(1001);
    for (float& number : numbers) spread.Add(number = normal(random));
    std::sort(numbers.begin(), numbers.end());
    EXPECT_EQ(spread.least(), numbers.front());
    EXPECT_EQ(spread.greatest(), numbers.back());
    EXPECT_NEAR(spread.middle(), numbers[500], std::abs(numbers[500]) / 16);
  }
}

TEST(CoordinateSpread, OutliersDoNotMoveTheMedian) {
  CoordinateSpread spread;
  for (const float number : {60.0f, 60.0f, 1e38f, 60.0f, -1e38f}) spread.Add(number);
  EXPECT_NEAR(spread.middle(), 60, 60.0 / 16);
}

TEST(CoordinateSpread, MergesToTheSpreadOfAllNumbersInAnyOrder) {
  CoordinateSpread low, high, all, merged, reverse, none;
  for (int i = -50; i < 100; ++i) {
    const auto number = static_cast<float>(i) / 3;
    (i < 20 ? low : high).Add(number);
    all.Add(number);
  }
  for (const CoordinateSpread* part : {&low, &none, &high}) merged.Merge(*part);
  for (const CoordinateSpread* part : {&high, &low}) reverse.Merge(*part);
  for (const CoordinateSpread* both : {&merged, &reverse}) {
    EXPECT_EQ(both->count(), all.count());
    EXPECT_EQ(both->least(), all.least());
    EXPECT_EQ(both->middle(), all.middle());
    EXPECT_EQ(both->greatest(), all.greatest());
  }
}

}  // namespace
}  // namespace albtpu::annotate
