#include "quality/planning/survey_plan.h"

#include <gtest/gtest.h>

#include <cmath>

namespace albtpu::quality {
namespace {

constexpr double kEnd = 40;  // m, of the table.

client::TableSummary Table() {
  client::TableSummary table;
  table.axes[Index(AxisId::kDepth)].last = kEnd;
  return table;
}

// A sea whose TVU is `slope` times the depth at 2 sigma, and that answers down to `last`.
class Sea {
 public:
  Sea(double slope, double last, double bias = 0) : slope_(slope), last_(last), bias_(bias) {}

  annotate::AnswerSource source() {
    return {table_, [this](const Query&, const annotate::PulseBatch& pulses, const annotate::AnswerSelection& selection,
                           annotate::AnswerBatch& answers) {
              answers.Resize(pulses.size, selection);
              for (std::size_t i = 0; i < pulses.size; ++i) {
                const float depth = pulses.coordinate(AxisId::kDepth, i);
                answers.outcomes[i] = depth <= last_ ? 1 : 2;
                for (auto& values : answers.values) values[i] = 1;
                answers.values[Index(Quantity::kThu)][i] = 0;
                answers.values[Index(Quantity::kTvu)][i] = static_cast<float>(slope_) * depth;
                answers.values[Index(Quantity::kBiasAlongBeam)][i] = 0;
                answers.values[Index(Quantity::kBiasVertical)][i] = static_cast<float>(bias_);
              }
              answers.sea_axes.clear();
              answers.wave_heights.clear();
              return absl::OkStatus();
            }};
  }

 private:
  client::TableSummary table_ = Table();
  double slope_, last_, bias_;
};

Reaches ReachesOver(Sea sea) {
  annotate::TotalPlan plan;  // Without an air side.
  plan.options.coverage = Coverage::kP95;
  return ReachOf(plan, sea.source(), {.altitude = 400, .incidence = 20, .footprint = 0.4, .wind_speed = 5, .fetch = {}})
      .value();
}

// TVU = 0.98 0.05 d meets sqrt(0.25^2 + (0.0075 d)^2) down to 0.25 / sqrt(0.049^2 - 0.0075^2) = 5.163 m.
TEST(DepthReach, IsWhereTheUncertaintyCrossesTheLimit) {
  const Reaches reaches = ReachesOver({0.05, kEnd});
  const double sigma95 = 1.959964 * 0.05 / 2;
  const double crossing = 0.25 / std::sqrt(sigma95 * sigma95 - 0.0075 * 0.0075);
  EXPECT_LE(Of(reaches, S44Order::kSpecial).depth, crossing);
  EXPECT_GT(Of(reaches, S44Order::kSpecial).depth, crossing - kReachStep);
  EXPECT_EQ(Of(reaches, S44Order::kSpecial).limit, ReachLimit::kTvu);
  EXPECT_LT(Of(reaches, S44Order::kExclusive).depth, Of(reaches, S44Order::kSpecial).depth);
  EXPECT_GT(Of(reaches, S44Order::k1a).depth, Of(reaches, S44Order::kSpecial).depth);
  EXPECT_EQ(Of(reaches, S44Order::k1a).depth, Of(reaches, S44Order::k1b).depth);
}

TEST(DepthReach, EndsWithTheTable) {
  const Reaches reaches = ReachesOver({0.001, 12});
  EXPECT_EQ(Of(reaches, S44Order::k1a).depth, 12);
  EXPECT_EQ(Of(reaches, S44Order::k1a).limit, ReachLimit::kTable);
  EXPECT_EQ(Of(ReachesOver({0.001, kEnd}), S44Order::k2).depth, kEnd);
  EXPECT_EQ(Of(ReachesOver({0.001, 0}), S44Order::k2).depth, 0);
}

TEST(DepthReach, CountsTheBias) {
  EXPECT_EQ(Of(ReachesOver({0, kEnd, 0.6}), S44Order::k1a).depth, 0);
  EXPECT_EQ(Of(ReachesOver({0, kEnd, 0.6}), S44Order::k1a).limit, ReachLimit::kTvu);
  EXPECT_EQ(Of(ReachesOver({0, kEnd, 0.6}), S44Order::k2).depth, kEnd);
}

TEST(DepthReach, TakesTheFootprintFromTheDivergence) {
  EXPECT_DOUBLE_EQ(annotate::FootprintAtIncidence(400, 1, 0), 0.4);
  EXPECT_NEAR(annotate::FootprintAtIncidence(400, 1, 60), 0.8, 1e-12);
}

SurveyPlan PlanOf(const std::vector<double>& depths) {
  SurveyPlan plan;
  plan.order = S44Order::k1a;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    plan.seas.push_back(static_cast<double>(i + 1));
    Reaches reaches;
    for (Reach& reach : reaches) reach.depth = depths[i];
    plan.planned.push_back(reaches);
  }
  return plan;
}

TEST(SurveyPlan, SaysHowMuchSeaThereMayBe) {
  const SurveyPlan plan = PlanOf({30, 20, 10, 25});  // A deep reach beyond a shallow one does not count.
  EXPECT_EQ(HighestSea(plan, S44Order::k1a, 10), 4);
  EXPECT_EQ(HighestSea(plan, S44Order::k1a, 15), 2);
  EXPECT_EQ(HighestSea(plan, S44Order::k1a, 35), std::nullopt);
}

TEST(ShareOfHours, CountsTheHoursInWhichADepthIsReached) {
  std::vector<Reaches> hours(4);
  const std::pair<double, ReachLimit> of_1a[] = {
      {3, ReachLimit::kTvu}, {10, ReachLimit::kThu}, {8, ReachLimit::kTable}, {0, ReachLimit::kWater}};
  for (std::size_t i = 0; i < hours.size(); ++i)
    hours[i][static_cast<std::size_t>(S44Order::k1a)] = {.depth = of_1a[i].first, .limit = of_1a[i].second};
  EXPECT_EQ(ShareOfHours(hours, S44Order::k1a, 3).met, 0.75);
  EXPECT_EQ(ShareOfHours(hours, S44Order::k1a, 3).unknown, 0.25);
  EXPECT_EQ(ShareOfHours(hours, S44Order::k1a, 9).met, 0.25);
  EXPECT_EQ(ShareOfHours(hours, S44Order::k1a, 9).unknown, 0.5);
  EXPECT_EQ(ShareOfHours({}, S44Order::k1a, 1).met, 0);
}

}  // namespace
}  // namespace albtpu::quality
