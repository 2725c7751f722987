#include "annotate/totals/water_column.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "annotate/answers/answer_counts.h"
#include "annotate/run/file_progress.h"
#include "annotate/totals/pulse_totals.h"
#include "annotate/totals/total_summary.h"
#include "sea/angle.h"

namespace albtpu::annotate {
namespace {

using ::testing::HasSubstr;

class WaterColumnPlan : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { setenv("ALBTPU_WATER_TABLE", SHIPPED_WATER_TABLE, 1); }

  static config::WaterSettings Water(const std::string& text) {
    const absl::StatusOr<config::SurveySettings> survey = config::ParseSurvey("[water]\n" + text, ".");
    EXPECT_TRUE(survey.ok()) << survey.status();
    return survey.ok() ? survey->water : config::WaterSettings();
  }
  static absl::StatusOr<WaterPlan> Plan(const std::string& text, std::vector<StatedNumber>* numbers = nullptr) {
    std::vector<StatedNumber> own;
    return PlanWater(Water(text), 1.34, numbers != nullptr ? *numbers : own);
  }
  static std::string ProblemOf(const std::string& text) {
    const absl::StatusOr<WaterPlan> plan = Plan(text);
    EXPECT_TRUE(formats::IsUsageError(plan.status())) << plan.status();
    return std::string(plan.status().message());
  }
};

const std::string kOptics = "kd = 0.15\nkd_kind = \"diffuse532\"\n";
const std::string kReceiver = "detector = \"peak\"\nfield_of_view = 16\npulse_length = 5\n";
const std::string kNone = "bias = \"none\"\n";

PulseBatch PulsesInWater() {
  PulseBatch pulses{.size = 4, .axis = {}};
  pulses[AxisId::kIncidence] = {20, 20, 40, 10};
  pulses[AxisId::kDepth] = {2, 200, 5, 5};
  pulses[AxisId::kFootprint] = {0.5, 0.5, 0.5, 7};
  return pulses;
}

AnswerBatch Answers() {
  AnswerBatch answers;
  AnswerSelection selection;
  SelectForTotals(selection);
  answers.Resize(4, selection);
  answers.outcomes.assign(4, 1);
  for (std::vector<float>& column : answers.values) column.assign(4, 0.1f);
  return answers;
}

TEST_F(WaterColumnPlan, SaysWhatIsMissingOrContradictsItself) {
  EXPECT_THAT(ProblemOf(kOptics + kNone), HasSubstr("detector, field_of_view (m), pulse_length (ns)"));
  EXPECT_THAT(ProblemOf(kReceiver + kNone), HasSubstr("nothing says how clear the water is"));
  EXPECT_THAT(ProblemOf(kReceiver + kNone + "kd = 0.1\n"), HasSubstr("kd_kind"));
  EXPECT_THAT(ProblemOf(kReceiver + kNone + kOptics + "secchi = 4\n"), HasSubstr("several ways"));
  EXPECT_THAT(ProblemOf(kReceiver + kOptics + kNone + "column = \"none\"\n"), HasSubstr("contradicts"));
  EXPECT_THAT(ProblemOf("residual_fraction = 0.1\ncolumn = \"none\"\n"), HasSubstr("residual_fraction contradicts"));
  EXPECT_THAT(ProblemOf("calibration = {depth = 5}\ncolumn = \"none\"\n"), HasSubstr("calibration contradicts"));
  EXPECT_THAT(ProblemOf("photons = 100\ncolumn = \"none\"\n"), HasSubstr("photons contradicts"));
  EXPECT_THAT(ProblemOf(kReceiver + kOptics + "bias = \"vendor\"\n"), HasSubstr("needs residual_fraction"));
  EXPECT_THAT(ProblemOf(kReceiver + kOptics + kNone + "residual_fraction = 0.1\n"), HasSubstr("has no effect"));
  EXPECT_THAT(ProblemOf(kReceiver + kOptics + "bias = \"calibrated\"\n"), HasSubstr("needs calibration"));
  EXPECT_THAT(ProblemOf(kReceiver + kOptics + "bias = \"calibrated\"\ncalibration = {depth = 5}\n"),
              HasSubstr("lacks a number"));
  EXPECT_THAT(ProblemOf("processed_with = 1.33\ncolumn = \"none\"\n"), HasSubstr("temperature"));
  EXPECT_THAT(ProblemOf(kReceiver + kNone + "kd = 0.05\nkd_kind = \"diffuse532\"\n"), HasSubstr("pure water"));
}

TEST_F(WaterColumnPlan, NamesWhatIsAssumed) {
  std::vector<StatedNumber> numbers;
  ASSERT_TRUE(Plan(kOptics + kReceiver + kNone, &numbers).ok());
  std::string assumed;
  for (const StatedNumber& number : numbers)
    if (number.assumed) assumed += number.name + " ";
  EXPECT_EQ(assumed, "processed_with water_attenuation_sigma water_albedo water_backscatter_fraction ");
}

TEST_F(WaterColumnPlan, LeavesOutWhatIsNotAskedFor) {
  std::vector<StatedNumber> numbers;
  const absl::StatusOr<WaterPlan> plan = Plan("column = \"none\"\n", &numbers);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->share, nullptr);
  EXPECT_EQ(numbers.back().name, "water_column");
  AnswerBatch answers = Answers();
  WaterBatch water;
  AddWater(*plan, PulsesInWater(), answers, water);
  EXPECT_TRUE(water.noise.empty());
  EXPECT_EQ(answers[Quantity::kBiasVertical][0], 0.1f);
}

TEST_F(WaterColumnPlan, AddsBiasesToThoseOfTheSeaAndMarksPulsesBeyond) {
  const absl::StatusOr<WaterPlan> plan = Plan(kOptics + kReceiver + kNone + "photons = 100\n");
  ASSERT_TRUE(plan.ok()) << plan.status();
  AnswerBatch answers = Answers();
  WaterBatch water;
  AddWater(*plan, PulsesInWater(), answers, water);
  const WaterAnswerOfSurvey expected = *plan->share->At(20, 2);
  EXPECT_NEAR(answers[Quantity::kBiasVertical][0], 0.1 + expected.bias_vertical, 1e-6);
  // The sea's 0.1 m is of the spot on a level bottom; a point 0.1 m too shallow is reported less far out.
  const double of_point = 0.1 - 0.1 * std::tan(std::asin(std::sin(RadiansOfDegrees(20)) / 1.34));
  EXPECT_NEAR(answers[Quantity::kBiasAlongBeam][0], of_point + expected.bias_along, 1e-6);
  EXPECT_LT(expected.bias_vertical, 0);
  EXPECT_NEAR(water.sigma_vertical[0], expected.left_vertical, 1e-6);
  EXPECT_NEAR(water.noise[0], plan->share->PhotonNoise(100, expected.stretch, std::cos(std::asin(0.342 / 1.34))), 1e-4);
  // Too deep, too slanted, too wide for the field of view.
  EXPECT_EQ(answers.outcomes, (std::vector<std::uint8_t>{1, kNoWater, kNoWater, kNoWater}));
  EXPECT_EQ(OutcomeName(answers, 1), "NO_WATER");
  EXPECT_TRUE(std::isnan(answers[Quantity::kBiasVertical][1]));
  EXPECT_TRUE(std::isnan(answers[Quantity::kBiasAlongBeam][1]));
}

TEST_F(WaterColumnPlan, AddsTheBiasOfAnotherIndex) {
  const absl::StatusOr<WaterPlan> plan =
      Plan("column = \"none\"\ntemperature = 15\nsalinity = 35\nprocessed_with = 1.33\n");
  ASSERT_TRUE(plan.ok()) << plan.status();
  PulseBatch pulses{.size = 1, .axis = {}};
  pulses[AxisId::kIncidence] = {0};
  pulses[AxisId::kDepth] = {10};
  AnswerBatch answers = Answers();
  WaterBatch water;
  AddWater(*plan, pulses, answers, water);
  EXPECT_NEAR(answers[Quantity::kBiasVertical][0], 0.1 - 0.2515, 1e-4);
}

config::SurveySettings SurveyWith(const std::string& text) {
  const absl::StatusOr<config::SurveySettings> survey = config::ParseSurvey(text, ".");
  EXPECT_TRUE(survey.ok()) << survey.status();
  return *survey;
}

TEST_F(WaterColumnPlan, AddsTheSurfaceThatAGreenLaserFinds) {
  const config::SurveySettings survey = SurveyWith("[surface]\nchannel = \"green\"\n[water]\n" + kOptics + kReceiver);
  WaterPlan plan;
  BudgetOptions options = {.errors = {.surface_range = 0.02}};
  std::vector<StatedNumber> numbers;
  ASSERT_EQ(PlanGreenSurface(survey, options, plan, numbers), absl::OkStatus());
  const GreenSurface surface = *plan.surface;
  EXPECT_NEAR(options.errors.surface_range, std::hypot(0.02, surface.spread), 1e-12);
  EXPECT_GT(surface.mean, 0.1);  // of a pulse of 5 ns
  AnswerBatch answers = Answers();
  WaterBatch water;
  AddWater(plan, PulsesInWater(), answers, water);
  const ShiftBySurface shift = ShiftBySurfaceOf(RadiansOfDegrees(20), 1.34);
  const double of_point = 0.1 - 0.1 * std::tan(std::asin(std::sin(RadiansOfDegrees(20)) / 1.34));
  EXPECT_NEAR(answers[Quantity::kBiasAlongBeam][0], of_point + shift.along * surface.mean, 1e-6);
  EXPECT_NEAR(answers[Quantity::kBiasVertical][0], 0.1 - shift.down * surface.mean, 1e-6);
  EXPECT_NEAR(water.sigma_along[0], shift.along * surface.unknown, 1e-6);
  EXPECT_NEAR(water.sigma_vertical[0], shift.down * surface.unknown, 1e-6);
  EXPECT_NEAR(water.correlation[0], -1, 1e-5);  // farther out and deeper

  // A model of many returns averages the spread out; the share of the water column adds as a covariance.
  options = {.errors = {.surface_range = 0.02}, .located = SurfaceLocation::kLocal};
  plan = *Plan(kOptics + kReceiver + kNone);
  WaterBatch column, both;
  answers = Answers();
  AddWater(plan, PulsesInWater(), answers, column);
  ASSERT_EQ(PlanGreenSurface(survey, options, plan, numbers), absl::OkStatus());
  EXPECT_EQ(options.errors.surface_range, 0.02);
  answers = Answers();
  AddWater(plan, PulsesInWater(), answers, both);
  const auto covariance = [](const WaterBatch& batch) {
    return batch.correlation[0] * batch.sigma_along[0] * batch.sigma_vertical[0];
  };
  EXPECT_NEAR(both.sigma_vertical[0], std::hypot(column.sigma_vertical[0], water.sigma_vertical[0]), 1e-6);
  EXPECT_NEAR(both.sigma_along[0], std::hypot(column.sigma_along[0], water.sigma_along[0]), 1e-6);
  EXPECT_NEAR(covariance(both), covariance(column) + covariance(water), 1e-7);
}

TEST_F(WaterColumnPlan, SaysWhyAGreenSurfaceCannotBeFound) {
  const auto problem = [](const std::string& water, SurfaceLocation located) {
    WaterPlan plan;
    BudgetOptions options = {.located = located};
    std::vector<StatedNumber> numbers;
    const absl::Status status =
        PlanGreenSurface(SurveyWith("[surface]\nchannel = \"green\"\n[water]\n" + water), options, plan, numbers);
    EXPECT_TRUE(formats::IsUsageError(status)) << status;
    return std::string(status.message());
  };
  EXPECT_THAT(problem(kOptics + kReceiver, SurfaceLocation::kLevel), HasSubstr("no effect where a level"));
  EXPECT_THAT(problem(kReceiver, SurfaceLocation::kPulse), HasSubstr("nothing says how clear the water is"));
  EXPECT_THAT(problem(kOptics, SurfaceLocation::kLocal), HasSubstr("detector and pulse_length"));
  EXPECT_THAT(problem(kOptics + "detector = \"centroid\"\npulse_length = 2\n", SurfaceLocation::kPulse),
              HasSubstr("give \"half\" or \"peak\""));
}

TEST_F(WaterColumnPlan, IsAShareOfTheTotal) {
  TotalPlan plan;
  plan.options.errors = {.position = {0.02, 0.03, 0.06}, .bottom_range = 0.025};
  plan.options.datum = 0.05;
  plan.water = *Plan(kOptics + kReceiver + kNone);
  AnswerBatch answers = Answers();
  TotalBatch totals;
  const PulseBatch pulses = PulsesInWater();
  AddWater(plan.water, pulses, answers, totals.water);
  AircraftColumns aircraft;
  aircraft[BudgetInput::kAltitude] = {400};
  aircraft[BudgetInput::kBeamAzimuth] = {10};
  ComputeTotals(plan, pulses, answers, aircraft, totals);
  const double vertical = totals.air[2][0] + totals.sea[2][0] + totals.of_water[2][0] + 0.05 * 0.05;
  EXPECT_NEAR(totals.tvu[0], 2 * std::sqrt(vertical), 1e-6);
  EXPECT_NEAR(totals.tvu_water[0], 2 * totals.water.sigma_vertical[0], 1e-6);
  EXPECT_TRUE(std::isnan(totals.tvu[1]));
  TotalSummary summary;
  summary.Add(pulses, answers, totals);
  const nlohmann::ordered_json json = summary.Json();
  EXPECT_EQ(json["pulses"], 1);
  double sum = 0;
  for (const auto& share : json["all"]["shares_vertical"]) sum += share.get<double>();
  EXPECT_NEAR(sum, 1, 1e-6);
  EXPECT_NEAR(json["all"]["shares_vertical"]["water"].get<double>(), totals.of_water[2][0] / vertical, 1e-5);
}

}  // namespace
}  // namespace albtpu::annotate
