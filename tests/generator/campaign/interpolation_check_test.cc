#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "generator/campaign/provenance.h"
#include "generator/campaign/table_maker.h"
#include "generator/math/statistics.h"
#include "tests/generator/campaign/two_seas.h"

namespace albtpu {
namespace {

Campaign Denser() {
  std::string text = TwoSeas().text;
  text.replace(text.find("[3, 6]"), 6, "[3, 4, 5, 6]");
  text.replace(text.find("[5000, inf]"), 11, "[5000, 15000, 45000, inf]");
  text.replace(text.find("[0.25, 1]"), 9, "[0.25, 0.4, 0.63, 1]");
  return *ParseCampaign(text);
}

InterpolationError ThuErrorOf(Campaign campaign) {
  campaign.checked_pulses = 40;
  const absl::StatusOr<UncertaintyTable> table = MakeTable(campaign, [](std::size_t) {});
  std::vector<std::vector<Estimate>> direct;
  for (std::size_t i = 0; i < campaign.checked_pulses; ++i)
    direct.push_back(ComputeDirectly(campaign, CheckedPulse(campaign, i)));
  return CompareWithTable(campaign, *table, direct, 2);
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

// Where the values are smooth, doubling the density of nodes along three axes divides the error by four.
TEST(InterpolationCheck, FindsLessErrorBetweenCloserNodes) {
  const InterpolationError coarse = ThuErrorOf(TwoSeas()), dense = ThuErrorOf(Denser());
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
  std::string text = TwoSeas().text;
  text.replace(text.find("[3, 6]"), 6, "[6]");
  text.replace(text.find("[5000, inf]"), 11, "[inf]");
  text.replace(text.find("[0, 20]"), 7, "[20]");
  text.replace(text.find("[0, 90]"), 7, "[90]");
  text.replace(text.find("[0.25, 1]"), 9, "[1]");
  text.replace(text.find("[0, 10]"), 7, "[10]");
  const Campaign campaign = *ParseCampaign(text);
  const InterpolationError error = ThuErrorOf(campaign);
  EXPECT_LE(error.greatest, std::max(1.07 * error.noise / 8, std::exp2(-kValueBits)));
}

}  // namespace
}  // namespace albtpu
