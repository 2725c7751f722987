#include "annotate/totals/plan_total.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "annotate/run/file_progress.h"
#include "config/survey_draft.h"

namespace albtpu::annotate {
namespace {

using ::testing::HasSubstr;

config::SurveySettings Survey(const std::string& text) {
  const absl::StatusOr<config::SurveySettings> survey = config::ParseSurvey(text, ".");
  EXPECT_TRUE(survey.ok()) << survey.status();
  return survey.value_or(config::SurveySettings());
}

std::string Sensor(const std::string& name) { return std::string(SHIPPED_SENSORS) + "/" + name + ".toml"; }

// Everything that must be decided.
std::string Decided(const std::string& sensor = "riegl-vq-880-g") {
  return "[sensor]\nname = \"" + Sensor(sensor) + "\"\n[datum]\nsigma = 0.08\n[water]\ncolumn = \"none\"\n";
}

constexpr double kAny = 1e-12;

const StatedNumber& Number(const TotalPlan& plan, const std::string& name) {
  const auto found = std::find_if(plan.numbers.begin(), plan.numbers.end(),
                                  [&](const StatedNumber& number) { return number.name == name; });
  EXPECT_NE(found, plan.numbers.end()) << name;
  return *found;
}

std::string ProblemOf(const std::string& text, const TotalContext& context = {.has_level = true}) {
  const absl::StatusOr<TotalPlan> plan = PlanTotal(Survey(text), context);
  return std::string(plan.status().message());
}

TEST(PlanTotal, TakesWhatTheUserSaysBeforeTheSensorAndTheSensorBeforeWhatIsAssumed) {
  const absl::StatusOr<TotalPlan> plan = PlanTotal(
      Survey(Decided() + "[sigma]\nbottom_range = 0.03\nposition = [0.01, 0.02, 0.03]\n"), {.has_level = true});
  ASSERT_TRUE(plan.ok()) << plan.status();
  const AirErrors& errors = plan->options.errors;
  EXPECT_NEAR(errors.bottom_range, 0.03, kAny);
  EXPECT_EQ(Number(*plan, "bottom_range").source, "[sigma]");
  EXPECT_EQ(errors.position, (std::array<double, 3>{0.01, 0.02, 0.03}));
  EXPECT_NEAR(errors.scan, 0.02, kAny);
  EXPECT_THAT(Number(*plan, "scan").source, HasSubstr("cBLUE"));
  EXPECT_FALSE(Number(*plan, "scan").assumed);
  EXPECT_EQ(errors.attitude, (std::array<double, 3>{0.005, 0.005, 0.008}));
  EXPECT_TRUE(Number(*plan, "attitude").assumed);
  EXPECT_NEAR(plan->options.datum, 0.08, kAny);
  EXPECT_EQ(plan->options.located, SurfaceLocation::kLevel);
  EXPECT_FALSE(plan->position_by_pulse);
}

TEST(PlanTotal, NamesAllThatIsAssumed) {
  const absl::StatusOr<TotalPlan> plan = PlanTotal(Survey(Decided()), {.has_level = true});
  ASSERT_TRUE(plan.ok()) << plan.status();
  std::set<std::string> assumed;
  for (const StatedNumber& number : plan->numbers)
    if (number.assumed) assumed.insert(number.name);
  EXPECT_EQ(assumed, (std::set<std::string>{"position", "attitude", "boresight", "lever_arm", "time", "range_offset",
                                            "surface_height", "index", "refractive_index", "lever_arm_vector"}));
  EXPECT_EQ(Assumptions(*plan).size(), assumed.size());
}

TEST(PlanTotal, TakesErrorsOfTheTrajectoryPulseByPulseUnlessTheUserOverridesThem) {
  const TotalContext files = {.has_level = true, .trajectory_errors = "smrmsg.out"};
  absl::StatusOr<TotalPlan> plan = PlanTotal(Survey(Decided()), files);
  ASSERT_TRUE(plan.ok());
  EXPECT_TRUE(plan->position_by_pulse);
  EXPECT_TRUE(plan->attitude_by_pulse);
  EXPECT_EQ(Number(*plan, "position").source, "smrmsg.out");
  plan = PlanTotal(Survey(Decided() + "[sigma]\nposition = [0, 0, 0]\n"), files);
  ASSERT_TRUE(plan.ok());
  EXPECT_FALSE(plan->position_by_pulse);
  EXPECT_TRUE(plan->attitude_by_pulse);
  plan = PlanTotal(Survey(Decided() + "[sigma]\nposition = [0, 0, 0]\n"), {.has_level = true});
  TakeErrorsOfTrajectory("position", *plan);
  EXPECT_FALSE(plan->position_by_pulse);
  EXPECT_TRUE(Number(*plan, "attitude").assumed);
  TakeErrorsOfTrajectory("attitude", *plan);
  EXPECT_TRUE(plan->attitude_by_pulse);
  EXPECT_EQ(Number(*plan, "attitude").source, "the trajectory");
  EXPECT_FALSE(Number(*plan, "attitude").assumed);
}

TEST(PlanTotal, LocatesTheSurfaceAsGivenElseByWhatThereIs) {
  const auto located = [&](const std::string& more, const TotalContext& context) {
    const absl::StatusOr<TotalPlan> plan = PlanTotal(Survey(Decided() + more), context);
    EXPECT_TRUE(plan.ok()) << plan.status();
    return plan->options.located;
  };
  EXPECT_EQ(located("", {.has_surface_returns = true, .has_level = true}), SurfaceLocation::kLocal);
  EXPECT_EQ(located("", {.has_level = true}), SurfaceLocation::kLevel);
  EXPECT_EQ(located("[surface]\nlocated = \"pulse\"\n", {.has_surface_returns = true}), SurfaceLocation::kPulse);
  EXPECT_THAT(ProblemOf(Decided(), {}), HasSubstr("nothing says how the surface was located"));
  EXPECT_THAT(ProblemOf(Decided() + "[surface]\nlocated = \"pulse\"\n"), HasSubstr("needs returns from the surface"));
}

TEST(PlanTotal, ErrsByTheRangeOfTheOwnReturn) {
  const absl::StatusOr<TotalPlan> plan =
      PlanTotal(Survey(Decided() + "[surface]\nlocated = \"pulse\"\n"), {.has_surface_returns = true});
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->options.errors.surface_range, 0.025);  // As good as that to the bottom.
  EXPECT_EQ(plan->options.errors.surface_height, 0);
  EXPECT_FALSE(plan->waves_unseen());
}

TEST(PlanTotal, TakesTheRangeToTheSurfaceForThatOfItsReturns) {
  const auto errors = [](const std::string& located) {
    const absl::StatusOr<TotalPlan> plan =
        PlanTotal(Survey(Decided() + "[surface]\nlocated = \"" + located + "\"\n[sigma]\nsurface_range = 0.04\n"),
                  {.has_surface_returns = true});
    EXPECT_TRUE(plan.ok()) << plan.status();
    return plan->options.errors;
  };
  EXPECT_EQ(errors("pulse").surface_range, 0.04);
  EXPECT_EQ(errors("pulse").surface_height, 0);
  EXPECT_EQ(errors("local").surface_range, 0);
  EXPECT_EQ(errors("local").surface_height, 0.04);
  EXPECT_THAT(ProblemOf(Decided() + "[sigma]\nsurface_range = 0.04\n"), HasSubstr("has no effect where a level"));
}

TEST(PlanTotal, CallsNothingTotalBeforeDatumAndWaterAreDecided) {
  const std::string sensor = "[sensor]\nname = \"" + Sensor("riegl-vq-880-g") + "\"\n";
  EXPECT_THAT(ProblemOf(sensor), HasSubstr("the vertical datum is not decided"));
  EXPECT_THAT(ProblemOf(sensor + "[datum]\nsigma = 0\n"), HasSubstr("the water column is not decided"));
  EXPECT_THAT(ProblemOf(sensor + "[datum]\nsigma = 0\n[water]\nkd = 0.1\n"), HasSubstr("column = \"none\""));
  EXPECT_TRUE(formats::IsUsageError(PlanTotal(Survey(sensor), {.has_level = true}).status()));
}

TEST(PlanTotal, TakesTheCumulativeUncertaintyOfADatumAtItsConfidence) {
  const auto plan = [](const std::string& datum) {
    std::string text = Decided();
    text.replace(text.find("sigma = 0.08"), 12, datum);
    const absl::StatusOr<TotalPlan> made = PlanTotal(Survey(text), {.has_level = true});
    EXPECT_TRUE(made.ok()) << made.status();
    return made.value_or(TotalPlan());
  };
  const TotalPlan at_sigma = plan("mcu = 0.115\nconfidence = \"1sigma\"\nregion = \"Delaware Bay\"");
  EXPECT_EQ(at_sigma.options.datum, 0.115);
  EXPECT_EQ(Number(at_sigma, "datum").value, "0.115 m");
  EXPECT_EQ(Number(at_sigma, "datum").source, "[datum] mcu 0.115 m at 1sigma, VDatum region Delaware Bay");
  const TotalPlan at_95 = plan("mcu = 0.2\nconfidence = \"95%\"");
  EXPECT_EQ(Number(at_95, "datum").source, "[datum] mcu 0.2 m at 95%");
  std::mt19937_64 random(8);
  std::normal_distribution<double> error(0, at_95.options.datum);
  constexpr int kDraws = 400'000;
  int within = 0;
  for (int i = 0; i < kDraws; ++i) within += std::abs(error(random)) <= 0.2;
  EXPECT_NEAR(within, 0.95 * kDraws, 4 * std::sqrt(0.95 * 0.05 * kDraws));
  EXPECT_EQ(Number(plan("sigma = 0.08\nregion = \"x\""), "datum").source, "[datum], VDatum region x");
}

TEST(PlanTotal, AddsWhatTheSurveyorAdds) {
  const absl::StatusOr<TotalPlan> none = PlanTotal(Survey(Decided()), {.has_level = true});
  ASSERT_TRUE(none.ok()) << none.status();
  EXPECT_FALSE(none->has_extra());
  const absl::StatusOr<TotalPlan> plan =
      PlanTotal(Survey(Decided() + "[extra]\nhorizontal = 0.3\nvertical = 0.05\n"), {.has_level = true});
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_TRUE(plan->has_extra());
  EXPECT_EQ(plan->options.extra_horizontal, 0.3);
  EXPECT_EQ(Number(*plan, "extra_horizontal").value, "0.3 m");
  EXPECT_EQ(Number(*plan, "extra_horizontal").source, "[extra], radial");
  EXPECT_EQ(Number(*plan, "extra_vertical").value, "0.05 m");
}

TEST(PlanTotal, NeverAssumesWhatOnlyTheSensorKnows) {
  const std::string problem = ProblemOf(Decided("usgs-eaarl-b"));
  EXPECT_THAT(problem, HasSubstr("scan (degree)"));
  EXPECT_THAT(problem, HasSubstr("[sigma]"));
  const std::vector<config::OpenDecision> open = UndecidedOf(Survey(Decided("usgs-eaarl-b")), {.has_level = true});
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].section, "sigma");
  EXPECT_EQ(open[0].message, problem);
  EXPECT_THAT(ProblemOf("[sensor]\nname = \"nothing.toml\"\n[datum]\nsigma = 0\n[water]\ncolumn = \"none\"\n"),
              HasSubstr("nothing.toml"));
}

TEST(WaveHeightOfWind, GrowsWithWindAndFetch) {
  EXPECT_EQ(WaveHeightOfWind(0, {}, ""), 0);
  const float developed = WaveHeightOfWind(5, {}, "Elfouhaily et al. (1997)");
  // A quarter of 1.2 times Pierson and Moskowitz's 0.0214 U^2.
  EXPECT_NEAR(developed, 1.2 * 0.0214 * 25 / 4, 0.02);
  EXPECT_LT(WaveHeightOfWind(5, 5000.0f, "Elfouhaily et al. (1997)"), 0.6f * developed);
  EXPECT_NE(WaveHeightOfWind(5, {}, "Apel (1994)"), developed);
}

TEST(PlanTotal, KnowsTheIndexByTemperatureAndSalinity) {
  const auto plan = [](const std::string& water) {
    const absl::StatusOr<TotalPlan> found = PlanTotal(Survey(Decided() + water), {.has_level = true});
    EXPECT_TRUE(found.ok()) << found.status();
    return *found;
  };
  const TotalPlan by_state = plan("temperature = 15\nsalinity = 35\n");
  EXPECT_NEAR(by_state.options.index, 1.34199, 5e-6);
  EXPECT_NEAR(by_state.options.errors.index, 0.0002, kAny);
  EXPECT_THAT(Number(by_state, "refractive_index").source, HasSubstr("temperature and salinity"));
  EXPECT_FALSE(Number(by_state, "refractive_index").assumed);
  EXPECT_TRUE(Number(by_state, "index").assumed);
  // Half of what is needed, and what is given outright.
  EXPECT_THAT(PlanTotal(Survey(Decided() + "salinity = 35\n"), {.has_level = true}).status().message(),
              HasSubstr("temperature and salinity go together"));
  const TotalPlan given = plan("temperature = 15\nsalinity = 35\nindex = 1.336\n");
  EXPECT_NEAR(given.options.index, 1.336, kAny);
  EXPECT_NEAR(given.options.errors.index, 0.002, kAny);
  EXPECT_EQ(Number(given, "refractive_index").source, "the user");
}

}  // namespace
}  // namespace albtpu::annotate
