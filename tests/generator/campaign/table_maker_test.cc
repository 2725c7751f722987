#include "generator/campaign/table_maker.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "generator/campaign/provenance.h"
#include "generator/campaign/water_cases.h"
#include "generator/math/statistics.h"
#include "sea/angle.h"
#include "tables/query/interpolation.h"
#include "tests/generator/campaign/two_seas.h"

namespace albtpu {
namespace {

absl::StatusOr<UncertaintyTable> Make(const Campaign& campaign) {
  return MakeTable(campaign, [](std::size_t) {});
}

// The table of the two seas, made once, and the counts of units that its maker reported.
struct Made {
  std::vector<std::size_t> counts;
  UncertaintyTable table = MakeTable(TwoSeas(), [this](std::size_t done) { counts.push_back(done); }).value();
};
const Made& TwoSeasMade() {
  static const Made made;
  return made;
}

TEST(TableMaker, HasAtANodeTheResultOfItsSeaCase) {
  const Campaign campaign = TwoSeas();
  const std::size_t index = 7;  // 6 m/s, fully developed, 1 m
  const SeaCaseResult result = Simulate(SeaCaseOf(campaign, index), campaign.effort, campaign.seed, kCellOfTables);
  const BeamUncertainty& beam = result.beams[3];  // 20 degrees, across the wind
  const PulseUncertainty interpolated =
      Interpolate(TwoSeasMade().table, {.wind_speed = 6, .incidence = 20, .azimuth = 90, .footprint = 1, .depth = 10});
  ASSERT_EQ(interpolated.outcome, Outcome::kInterpolated);
  const Estimate& along = beam.refraction_along_wind;
  const Estimate degrees{DegreesOfRadians(along.value), DegreesOfRadians(along.standard_error)};
  EXPECT_EQ(interpolated[Quantity::kRefractionAlongWind], Rounded(degrees).value);
  EXPECT_EQ(interpolated[Quantity::kThu], Rounded(beam.thu[1]).value);
  EXPECT_EQ(interpolated[Quantity::kTvu], Rounded(beam.tvu[1]).value);
  EXPECT_EQ(interpolated[Quantity::kBiasVertical], Rounded(beam.bias_vertical[1]).value);
  EXPECT_EQ(interpolated.standard_errors[Index(Quantity::kThu)], Rounded(beam.thu[1]).standard_error);
}

// Between a calm, which is exactly 0, and the next wind, values are in proportion to the wind.
TEST(TableMaker, AnswersFromACalmOn) {
  std::string text = TwoSeas().text;
  text.replace(text.find("[3, 6]"), 6, "[0, 4]");
  text.insert(text.find("[effort]"), "[sea]\nspectrum = \"elfouhaily\"\n");
  const absl::StatusOr<UncertaintyTable> table = Make(*ParseCampaign(text));
  const auto at = [&](float wind) {
    return Interpolate(*table, {.wind_speed = wind, .incidence = 20, .azimuth = 90, .footprint = 1, .depth = 10});
  };
  const PulseUncertainty calm = at(0), light = at(1), wind = at(4);
  ASSERT_EQ(calm.outcome, Outcome::kInterpolated);
  for (const Quantity quantity : kQuantities) {
    EXPECT_EQ(calm[quantity], 0);
    EXPECT_EQ(calm.standard_errors[Index(quantity)], 0);
    EXPECT_FLOAT_EQ(light[quantity], wind[quantity] / 4);
  }
  const Provenance& provenance = table->provenance();
  EXPECT_THAT(std::get<std::string>(provenance.attributes.at("spectrum")), ::testing::HasSubstr("Elfouhaily"));
  EXPECT_EQ(std::get<std::vector<double>>(provenance.attributes.at("realizations")), (std::vector<double>{40, 40}));
}

TEST(TableMaker, StatesHowItTraced) {
  const auto estimator = [](const UncertaintyTable& table) {
    return std::get<std::string>(table.provenance().attributes.at("estimator"));
  };
  EXPECT_EQ(estimator(TwoSeasMade().table), "control_variate");
  std::string text = TwoSeas().text;
  text.insert(text.find("[effort]"), "[beam]\nsource_height = 400\n");
  EXPECT_EQ(estimator(*Make(*ParseCampaign(text))), "plain");
}

TEST(TableMaker, RefusesValuesThatAreNotFinite) {
  const Campaign campaign = TwoSeas();
  TableBuilder builder(campaign);
  const auto status_of = [&](const SeaCaseResult& result) {
    return builder.Add({UnitKind::kSeaCase, 0},
                       SealUnit({UnitKind::kSeaCase, 0}, OriginOf(campaign), EncodeResult(result)));
  };
  const std::vector<Estimate> depths(2);
  SeaCaseResult result;
  result.beams.assign(4, {{}, {}, depths, depths, depths, depths});
  EXPECT_TRUE(status_of(result).ok());
  result.beams[2].tvu[1].standard_error = NAN;
  EXPECT_THAT(std::string(status_of(result).message()), ::testing::HasSubstr("not finite"));

  std::vector<Estimate> checked(kChecked.size());
  checked[1].value = NAN;
  const UnitId pulse{UnitKind::kPulse, 0};
  EXPECT_THAT(std::string(builder.Add(pulse, SealUnit(pulse, OriginOf(campaign), EncodeEstimates(checked))).message()),
              ::testing::HasSubstr("not finite"));
}

// In water from which no photon comes back.
TEST(TableMaker, ComparesNoBeamWhoseEchoHasNoClearEnd) {
  const Campaign campaign = *ParseCampaign(R"(id = "water"
kind = "water_column"
version = "1"
title = "One water"
[axes]
backscatter_fraction = [0.01]
scattering_over_absorption = [2]
incidence = [0]
optical_depth = [0.2]
field_of_view = [3]
pulse_length = [0.3]
[effort]
photons = 1000
[interpolation]
checked_pulses = 1
)");
  CheckedBeam beam = CheckedBeamOf(campaign, 0);
  const std::vector<Estimate> clear = ComputeDirectly(campaign, beam);
  beam.beam.optical_depth = 100;
  std::vector<Estimate> unclear = ComputeDirectly(campaign, beam);
  EXPECT_TRUE(std::isfinite(clear[0].standard_error));
  EXPECT_TRUE(std::isinf(unclear[0].standard_error));

  unclear.back() = clear.back();  // Energy alone does not make an echo.
  const std::vector<std::vector<Estimate>> cases = {ComputeWaterCase(campaign, 0)};
  for (const auto& [direct, beams] : {std::pair(clear, 1.0), std::pair(unclear, 0.0)}) {
    const absl::StatusOr<Table> table = BuildWaterTable(campaign, cases, {direct});
    ASSERT_TRUE(table.ok()) << table.status();
    EXPECT_EQ(
        std::get<std::vector<double>>(table->provenance().attributes.at("interpolation_error_bias_vertical_peak"))[4],
        beams);
  }
}

TEST(TableMaker, MakesTheSameTableOnOneThread) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(Make(TwoSeas())->digest(), TwoSeasMade().table.digest());
}

TEST(TableMaker, ReportsTheNumberOfFinishedUnits) {
  const std::vector<std::size_t>& counts = TwoSeasMade().counts;
  ASSERT_EQ(counts.size(), 8 + TwoSeas().checked_pulses);
  for (std::size_t i = 0; i < counts.size(); ++i) EXPECT_EQ(counts[i], i + 1);
}

UncertaintyTable::Axes Axes(const std::vector<double>& winds, const std::vector<double>& footprints) {
  return {*Axis::Create(AxisId::kWindSpeed, winds),      *Axis::Create(AxisId::kFetch, {1e5}),
          *Axis::Create(AxisId::kIncidence, {0}),        *Axis::Create(AxisId::kAzimuth, {0}),
          *Axis::Create(AxisId::kFootprint, footprints), *Axis::Create(AxisId::kDepth, {0, 10})};
}

TEST(NodeBalance, DoesNotChangeValuesLinearInTheScaleOfEachAxis) {
  const UncertaintyTable::Axes axes = Axes({1, 2, 4, 5}, {0.5, 1, 3});
  std::vector<float> values;
  for (const double wind : axes[0].nodes()) {
    for (const double footprint : axes[4].nodes())
      for (const double depth : {0.0, 10.0})
        values.push_back(static_cast<float>(20 + 3 * wind - 2 * std::log(footprint) + depth));
  }
  std::vector<float> balanced = values;
  BalanceNodes(axes, Quantity::kThu, balanced);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(balanced[i], values[i], 1e-5) << i;
}

// x^2 on a uniform grid: at the distance t from the middle of an interval, interpolation errs by h^2 / 4 - t^2, with
// the mean h^2 / 6. The root mean square error is h^2 sqrt(1 / 30) before and h^2 sqrt(1 / 180) without the mean.
TEST(NodeBalance, RemovesTheMeanError) {
  const std::vector<double> x = {2, 3, 4, 5, 6, 7};
  const UncertaintyTable::Axes axes = Axes(x, {1});
  std::vector<float> values;
  for (const double wind : x)
    for (int depth = 0; depth < 2; ++depth) values.push_back(static_cast<float>(wind * wind));
  BalanceNodes(axes, Quantity::kThu, values);
  double sum = 0, squares = 0;
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps;
    const double error = (1 - t) * values[4] + t * values[6] - std::pow(4 + t, 2);
    sum += error / kSteps;
    squares += error * error / kSteps;
  }
  EXPECT_NEAR(sum, 0, 1e-5);
  EXPECT_NEAR(std::sqrt(squares), std::sqrt(1 / 180.0), 1e-5);
  EXPECT_EQ(values[0], 4);  // the ends do not change
  EXPECT_EQ(values[10], 49);
}

// Between a calm and the first wind, the curve is not that of the winds above.
TEST(NodeBalance, KeepsTheFirstWindAboveACalm) {
  const UncertaintyTable::Axes axes = Axes({0, 2, 3, 4}, {1});
  std::vector<float> values = {0, 0, 8, 8, 27, 27, 64, 64};
  const std::vector<float> exact = values;
  BalanceNodes(axes, Quantity::kThu, values);
  for (const int i : {0, 2, 6}) EXPECT_EQ(values[i], exact[i]);
  EXPECT_LT(values[4], exact[4]);
}

TEST(NodeBalance, KeepsAtLeastHalfOfAQuantityThatCannotBeNegative) {
  const UncertaintyTable::Axes axes = Axes({1, 2, 3}, {1});
  std::vector<float> thu = {100, 100, 0.1f, 0.1f, 100, 100}, bias = thu;
  BalanceNodes(axes, Quantity::kThu, thu);
  EXPECT_FLOAT_EQ(thu[2], 0.05f);
  BalanceNodes(axes, Quantity::kBiasVertical, bias);
  EXPECT_LT(bias[2], 0);
}

// The two seas with these lists of nodes instead of their own.
Campaign With(const std::vector<std::pair<std::string, std::string>>& lists) {
  std::string text = TwoSeas().text;
  for (const auto& [from, to] : lists) text.replace(text.find(from), from.size(), to);
  return *ParseCampaign(text);
}

// THU of the first pulses, computed without a table.
std::vector<std::vector<Estimate>> Directly(const Campaign& campaign, std::size_t pulses) {
  std::vector<std::vector<Estimate>> direct;
  for (std::size_t i = 0; i < pulses; ++i) direct.push_back(ComputeDirectly(campaign, CheckedPulse(campaign, i)));
  return direct;
}

InterpolationError ThuErrorOf(Campaign campaign, const std::vector<std::vector<Estimate>>& direct) {
  campaign.checked_pulses = 1;  // by the table maker itself
  return CompareWithTable(campaign, *Make(campaign), direct, 2);
}

TEST(InterpolationCheck, DrawsPulsesUniformlyOverTheAxes) {
  const Campaign campaign = TwoSeas();
  double least = 1, greatest = 0, mean_log_footprint = 0;
  constexpr int kPulses = 400;
  for (int i = 0; i < kPulses; ++i) {
    const Pulse pulse = CheckedPulse(campaign, i);
    const double depth = pulse.depth / 10;
    least = std::min(least, depth);
    greatest = std::max(greatest, depth);
    mean_log_footprint += std::log(pulse.footprint) / kPulses;
    ASSERT_GE(pulse.fetch, 5000);
    ASSERT_LE(*pulse.azimuth, 90);
  }
  EXPECT_LT(least, 0.02);
  EXPECT_GT(greatest, 0.98);
  // Uniform in the logarithm from 0.25 to 1, within four standard errors.
  EXPECT_NEAR(mean_log_footprint, std::log(0.5), 4 * std::log(4.0) / std::sqrt(12.0 * kPulses));
}

// Where the values are smooth, a third of the distance between nodes along two axes divides the error by nine. Pulses
// lie between the ends of the axes, which are the same.
TEST(InterpolationCheck, FindsLessErrorBetweenCloserNodes) {
  std::vector<std::pair<std::string, std::string>> lists = {
      {"[3, 6]", "[6]"}, {"[0, 20]", "[20]"}, {"[0, 90]", "[90]"}};
  const Campaign wide = With(lists);
  lists.insert(lists.end(), {{"[5000, inf]", "[5000, 15000, 45000, inf]"}, {"[0.25, 1]", "[0.25, 0.4, 0.63, 1]"}});
  const Campaign close = With(lists);
  const std::vector<std::vector<Estimate>> direct = Directly(wide, 40);
  const InterpolationError coarse = ThuErrorOf(wide, direct), dense = ThuErrorOf(close, direct);
  EXPECT_GT(coarse.pulses, 20);
  EXPECT_LT(dense.rms, 0.5 * coarse.rms);
  EXPECT_LE(dense.rms, dense.greatest);
  EXPECT_LE(dense.percentile_99, dense.greatest);
}

// A pulse at a node: the widest beam of the campaign determines grid and patch for both.
TEST(InterpolationCheck, ComputesPulsesOnTheSurfacesOfTheNodes) {
  const Campaign campaign = TwoSeas();
  const Pulse pulse{.wind_speed = 6, .fetch = 5000, .incidence = 0, .azimuth = 0, .footprint = 0.25, .depth = 10};
  const SeaCase sea_case = SeaCaseOf(campaign, 4);  // the second wind, the first fetch and footprint
  ASSERT_EQ(std::get<WindSea>(sea_case.sea.waves).wind_speed_10m, 6);
  const SeaCaseResult node = Simulate(sea_case, campaign.effort, campaign.seed, kCellOfTables);
  EXPECT_EQ(ComputeDirectly(campaign, pulse)[2].value, node.beams[0].thu[1].value);
}

// A pulse at a node has the same surfaces as the node. Only the rounding of the values remains (Rounded).
TEST(InterpolationCheck, FindsNoErrorAtANode) {
  const Campaign campaign = With({{"[3, 6]", "[6]"},
                                  {"[5000, inf]", "[inf]"},
                                  {"[0, 20]", "[20]"},
                                  {"[0, 90]", "[90]"},
                                  {"[0.25, 1]", "[1]"},
                                  {"[0, 10]", "[10]"}});
  const InterpolationError error = ThuErrorOf(campaign, Directly(campaign, 2));
  EXPECT_LE(error.greatest, std::max(1.07 * error.noise / 8, std::exp2(-kValueBits)));
}

}  // namespace
}  // namespace albtpu
