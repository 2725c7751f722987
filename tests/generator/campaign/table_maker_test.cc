#include "generator/campaign/table_maker.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <string>

#include "generator/math/statistics.h"
#include "sea/angle.h"
#include "tables/query/interpolation.h"
#include "tests/generator/campaign/two_seas.h"

namespace albtpu {
namespace {

absl::StatusOr<UncertaintyTable> Make(const Campaign& campaign) {
  return MakeTable(campaign, [](std::size_t) {});
}

TEST(TableMaker, HasAtANodeTheResultOfItsSeaCase) {
  const Campaign campaign = TwoSeas();
  const absl::StatusOr<UncertaintyTable> table = Make(campaign);
  const std::size_t index = 7;  // 6 m/s, fully developed, 1 m
  const SeaCaseResult result = Simulate(SeaCaseOf(campaign, index), campaign.effort, campaign.seed, kCellOfTables);
  const BeamUncertainty& beam = result.beams[3];  // 20 degrees, across the wind
  const PulseUncertainty interpolated =
      Interpolate(*table, {.wind_speed = 6, .incidence = 20, .azimuth = 90, .footprint = 1, .depth = 10});
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
  EXPECT_THAT(std::get<std::string>(provenance.attributes.at("spectrum")), testing::HasSubstr("Elfouhaily"));
  EXPECT_EQ(std::get<std::vector<double>>(provenance.attributes.at("realizations")), (std::vector<double>{40, 40}));
}

TEST(TableMaker, MakesTheSameTableOnAnyNumberOfThreads) {
  const Campaign campaign = TwoSeas();
  std::string digests[2];
  for (const int threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const absl::StatusOr<UncertaintyTable> table = Make(campaign);
    digests[threads - 1] = table->digest();
  }
  EXPECT_EQ(digests[0], digests[1]);
}

TEST(TableMaker, ReportsTheNumberOfFinishedUnits) {
  std::vector<std::size_t> counts;
  ASSERT_TRUE(MakeTable(TwoSeas(), [&](std::size_t done) { counts.push_back(done); }).ok());
  ASSERT_EQ(counts.size(), 8 + TwoSeas().checked_pulses);
  for (std::size_t i = 0; i < counts.size(); ++i) EXPECT_EQ(counts[i], i + 1);
}

}  // namespace
}  // namespace albtpu
