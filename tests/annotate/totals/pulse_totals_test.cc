#include "annotate/totals/pulse_totals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "annotate/totals/total_summary.h"

namespace albtpu::annotate {
namespace {

constexpr std::size_t kPulses = 3;

PulseBatch Pulses() {
  PulseBatch pulses{.size = kPulses, .axis = {}};
  pulses[AxisId::kIncidence] = {20};
  pulses[AxisId::kDepth] = {2, 6, 12};
  return pulses;
}

AnswerBatch Sea() {
  AnswerBatch sea;
  AnswerSelection selection;
  SelectForTotals(selection);
  sea.Resize(kPulses, selection);
  for (std::size_t i = 0; i < kPulses; ++i) {
    sea.outcomes[i] = 1;
    sea.values[Index(Quantity::kThu)][i] = 0.1f * static_cast<float>(i + 1);
    sea.values[Index(Quantity::kTvu)][i] = 0.02f * static_cast<float>(i + 1);
    sea.values[Index(Quantity::kRefractionAlongWind)][i] = 2;
    sea.values[Index(Quantity::kRefractionCrossWind)][i] = 1;
    sea.values[Index(Quantity::kBiasAlongBeam)][i] = NAN;
    sea.values[Index(Quantity::kBiasVertical)][i] = -0.01f;
  }
  return sea;
}

TotalPlan Plan() {
  TotalPlan plan;
  plan.options.errors = {.position = {0.02, 0.03, 0.06}, .attitude = {0.005, 0.005, 0.008}, .bottom_range = 0.025};
  plan.options.datum = 0.05;
  plan.options.extra_horizontal = 0.04;
  plan.options.extra_vertical = 0.03;
  plan.sea_axis = 70;
  return plan;
}

AircraftColumns Aircraft() {
  AircraftColumns aircraft;
  aircraft[BudgetInput::kAltitude] = {400};
  aircraft[BudgetInput::kBeamAzimuth] = {10, 100, 190};
  return aircraft;
}

TEST(ComputeTotals, AddsTheShares) {
  AircraftColumns aircraft = Aircraft();
  TotalBatch totals;
  ComputeTotals(Plan(), Pulses(), Sea(), aircraft, totals);
  for (std::size_t i = 0; i < kPulses; ++i) {
    const double vertical = totals.air[2][i] + totals.sea[2][i] + 0.05 * 0.05 + 0.03 * 0.03;
    EXPECT_NEAR(totals.tvu[i], 2 * std::sqrt(vertical), 1e-6);
    EXPECT_NEAR(totals.thu[i], std::hypot(totals.thu_air[i], totals.thu_sea[i], 2 * 0.04), 1e-6);
    EXPECT_NEAR(totals.extra.thu, 2 * 0.04, 1e-6);
    EXPECT_NEAR(totals.extra.tvu, 2 * 0.03, 1e-6);
    EXPECT_NEAR(totals.thu_sea[i], 2 * std::sqrt(totals.sea[0][i] + totals.sea[1][i]), 1e-6);
    // The reported point moves less than the spot on a level bottom, of which the sea's answer is.
    EXPECT_LT(totals.thu_sea[i], 0.1 * static_cast<double>(i + 1));
    EXPECT_GT(totals.thu_sea[i], 0.09 * static_cast<double>(i + 1));
  }
}

TEST(ComputeTotals, TakesSigmasOfThePulseWhereTheyAreKnown) {
  TotalPlan plan = Plan();
  plan.position_by_pulse = true;
  AircraftColumns aircraft = Aircraft();
  for (std::size_t axis = 0; axis < 3; ++axis) aircraft[BudgetInput::kPositionSigmaNorth + axis] = {1, NAN, 1};
  TotalBatch totals, assumed;
  ComputeTotals(plan, Pulses(), Sea(), aircraft, totals);
  aircraft = Aircraft();
  ComputeTotals(Plan(), Pulses(), Sea(), aircraft, assumed);
  EXPECT_EQ(totals.sigmas_assumed, 1u);
  EXPECT_GT(totals.tvu[0], 2);
  EXPECT_EQ(totals.tvu[1], assumed.tvu[1]);
}

TEST(ComputeTotals, StatesNoHorizontalCovarianceWithoutADirection) {
  AircraftColumns aircraft = Aircraft();
  aircraft[BudgetInput::kBeamAzimuth].clear();
  TotalBatch totals;
  ComputeTotals(Plan(), Pulses(), Sea(), aircraft, totals);
  EXPECT_TRUE(std::isnan(totals.covariance[0][0]));
  EXPECT_FALSE(std::isnan(totals.covariance[2][0]));
  EXPECT_FALSE(std::isnan(totals.thu[0]));
}

TEST(ComputeTotals, SeesWavesOnlyInTheReturnOfThePulse) {
  TotalPlan plan = Plan();
  plan.wave_height = 0.25f;
  AircraftColumns aircraft = Aircraft();
  TotalBatch by_pulse, by_level;
  ComputeTotals(plan, Pulses(), Sea(), aircraft, by_pulse);
  plan.options.located = SurfaceLocation::kLocal;
  ComputeTotals(plan, Pulses(), Sea(), aircraft, by_level);
  EXPECT_NEAR(by_pulse.tvu_sea[0], 0.02, 1e-6);
  EXPECT_NEAR(by_level.tvu_sea[0], std::hypot(0.02, 2 * 0.25 * 0.2321), 1e-3);
}

TEST(TotalSummary, StatesSharesThatAddUp) {
  AircraftColumns aircraft = Aircraft();
  TotalBatch totals;
  const PulseBatch pulses = Pulses();
  const AnswerBatch sea = Sea();
  ComputeTotals(Plan(), pulses, sea, aircraft, totals);
  TotalSummary all, first, second;
  all.Add(pulses, sea, totals);
  first.Add(pulses, sea, totals, 0);
  second.Add(pulses, sea, totals, 1);
  second.Add(pulses, sea, totals, 2);
  first.Merge(second);
  const nlohmann::ordered_json json = all.Json();
  EXPECT_EQ(first.Json().dump(), json.dump());
  EXPECT_EQ(json["pulses"], 3);
  EXPECT_EQ(json["depth_bands"].size(), 3u);
  for (const char* axis : {"shares_horizontal", "shares_vertical", "groups_horizontal", "groups_vertical"}) {
    double sum = 0;
    for (const auto& share : json["all"][axis]) sum += share.get<double>();
    EXPECT_NEAR(sum, 1, 1e-6) << axis;
  }
  double vertical = 0;
  for (std::size_t i = 0; i < kPulses; ++i) vertical += std::pow(totals.tvu[i] / 2, 2);
  const auto& shares = json["all"]["shares_vertical"];
  EXPECT_NEAR(shares["extra"].get<double>(), 3 * 0.03 * 0.03 / vertical, 1e-6);
  EXPECT_NEAR(shares["datum"].get<double>(), 3 * 0.05 * 0.05 / vertical, 1e-6);
  EXPECT_NE(all.Text(Coverage::kTwoSigma, S44Order::k1b).find("extra"), std::string::npos);
  EXPECT_NEAR(json["all"]["mean_bias_vertical"].get<double>(), -0.01, 1e-6);
  EXPECT_EQ(json["all"]["s44_met"]["2"], 3);
}

TEST(LengthSpread, FindsQuantilesToAPerCent) {
  LengthSpread spread, rest;
  for (int i = 1; i <= 1000; ++i) (i % 3 == 0 ? rest : spread).Add(static_cast<float>(i) / 1000);
  spread.Merge(rest);
  EXPECT_EQ(spread.count(), 1000u);
  EXPECT_NEAR(spread.mean(), 0.5005, 1e-6);
  EXPECT_NEAR(spread.quantile(0.5), 0.5, 0.006);
  EXPECT_NEAR(spread.quantile(0.95), 0.95, 0.01);
  EXPECT_EQ(spread.greatest(), 1);
}

// A length alone: the middle of its bin, by the logarithm, or itself where that is less.
TEST(LengthSpread, HasBinsOfAPerCent) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> logarithm(std::log(1e-5), std::log(1e5));
  const auto check = [](float metres) {
    LengthSpread spread;
    spread.Add(metres);
    const double bin = std::clamp(std::floor(std::log(std::max(1e-4, double{metres}) / 1e-4) / 0.01), 0.0, 1842.0);
    EXPECT_DOUBLE_EQ(spread.quantile(0.5), std::min(1e-4 * std::exp(0.01 * (bin + 0.5)), double{metres})) << metres;
  };
  for (int i = 0; i < 3000; ++i) check(static_cast<float>(std::exp(logarithm(random))));
  for (int bin = -1; bin < 1850; ++bin) {
    const auto bound = static_cast<float>(1e-4 * std::exp(0.01 * bin));
    for (const float metres : {std::nextafter(bound, 0.f), bound, std::nextafter(bound, 1e9f)}) check(metres);
  }
  for (const float metres : {0.f, 1e-30f, 1e4f, 16384.f, 3e38f}) check(metres);
}

// Of a grid whose north points 30 degrees east of true north. An error of fixed direction has the covariance of its
// outer product: (north, east, down) = (0.3, -0.2, 0.1) is x = -0.3 sin 30 - 0.2 cos 30, y = 0.3 cos 30 - 0.2 sin 30.
TEST(OnGridAxes, TurnsAnErrorIntoTheGrid) {
  const float north = 0.3f, east = -0.2f, down = 0.1f;
  const std::array<std::vector<float>, 6> covariance = {
      {{north * north}, {east * east}, {down * down}, {north * east}, {north * down}, {east * down}}};
  const float x = -0.15f - 0.2f * 0.8660254f, y = 0.3f * 0.8660254f - 0.1f, z = -down;
  const float expected[] = {x * x, y * y, z * z, x * y, x * z, y * z};
  const std::array<float, 6> grid = OnGridAxes(covariance, 0, 0.52359878f);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(grid[i], expected[i], 1e-7) << i;
}

}  // namespace
}  // namespace albtpu::annotate
