#include "generator/table_maker.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "generator/angle.h"
#include "generator/closed_form.h"
#include "generator/rounding.h"
#include "tables/interpolation.h"

namespace albtpu {
namespace {

Campaign SmallCampaign() {
  const absl::StatusOr<Campaign> campaign = ParseCampaign(R"(id = "small"
version = "1"
title = "Two seas"
[axes]
wind_speed = [3, 6]
fetch = [5000, inf]
incidence = [0, 20]
azimuth = [0, 90]
footprint = [0.25, 1]
depth = [0, 10]
[effort]
realizations = 40
)");
  EXPECT_TRUE(campaign.ok()) << campaign.status();
  return *campaign;
}

absl::StatusOr<UncertaintyTable> Make(const Campaign& campaign) {
  return MakeTable(campaign, [](std::size_t) {});
}

TEST(TableMaker, AnswersAtANodeWhatTheSimulationOfItsEncounterGives) {
  const Campaign campaign = SmallCampaign();
  const absl::StatusOr<UncertaintyTable> table = Make(campaign);
  ASSERT_TRUE(table.ok()) << table.status();
  const std::size_t index = 7;  // 6 m/s, fully developed, 1 m
  const EncounterResult result = Simulate(EncounterOf(campaign, index), campaign.effort, campaign.seed,
                                          static_cast<std::uint32_t>(index));
  const BeamUncertainty& beam = result.beams[3];  // 20 degrees, across the wind
  const PulseUncertainty answer =
      Interpolate(*table, {.wind_speed = 6, .incidence = 20, .azimuth = 90, .footprint = 1, .depth = 10});
  ASSERT_EQ(answer.outcome, Outcome::kInterpolated);
  const Estimate& along = beam.refraction_along_wind;
  const Estimate degrees{DegreesOfRadians(along.value), DegreesOfRadians(along.standard_error)};
  EXPECT_EQ(answer[Quantity::kRefractionAlongWind], Rounded(degrees).value);
  EXPECT_EQ(answer[Quantity::kThu], Rounded(beam.thu[1]).value);
  EXPECT_EQ(answer[Quantity::kTvu], Rounded(beam.tvu[1]).value);
  EXPECT_EQ(answer[Quantity::kBiasVertical], Rounded(beam.bias_vertical[1]).value);
  EXPECT_EQ(answer.standard_errors[Index(Quantity::kThu)], Rounded(beam.thu[1]).standard_error);
}

TEST(TableMaker, MakesTheSameTableOnAnyNumberOfThreads) {
  const Campaign campaign = SmallCampaign();
  std::string digests[2];
  for (const int threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const absl::StatusOr<UncertaintyTable> table = Make(campaign);
    ASSERT_TRUE(table.ok()) << table.status();
    digests[threads - 1] = table->digest();
  }
  EXPECT_EQ(digests[0], digests[1]);
}

TEST(TableMaker, CountsEncountersAsTheyAreDone) {
  std::vector<std::size_t> counts;
  ASSERT_TRUE(MakeTable(SmallCampaign(), [&](std::size_t done) { counts.push_back(done); }).ok());
  EXPECT_EQ(counts, (std::vector<std::size_t>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(TableMaker, PutsTheClosedFormAtTheNodesOfItsTable) {
  const Campaign campaign = SmallCampaign();
  const absl::StatusOr<UncertaintyTable> table = MakeClosedFormTable(campaign);
  ASSERT_TRUE(table.ok()) << table.status();
  const SmallSlopeUncertainty closed = ClosedForm(
      SeaState(3, 5000), {.incidence = RadiansOfDegrees(20), .azimuth = 0, .footprint = 0.25}, 1.33);
  const PulseUncertainty answer = Interpolate(
      *table,
      {.wind_speed = 3, .fetch = 5000, .incidence = 20, .azimuth = 0, .footprint = 0.25f, .depth = 10});
  EXPECT_FLOAT_EQ(answer[Quantity::kThu], static_cast<float>(10 * closed.thu_per_depth));
  EXPECT_FLOAT_EQ(answer[Quantity::kTvu], static_cast<float>(10 * closed.tvu_per_depth));
  EXPECT_TRUE(std::isnan(answer[Quantity::kBiasVertical]));
}

TEST(TableMaker, MeasuresLessInterpolationErrorOnDenserAxes) {
  const absl::StatusOr<InterpolationError> coarse = MeasureInterpolationError(SmallCampaign());
  ASSERT_TRUE(coarse.ok()) << coarse.status();
  std::string text = SmallCampaign().text;
  text.replace(text.find("[3, 6]"), 6, "[3, 4, 5, 6]");
  text.replace(text.find("[5000, inf]"), 11, "[5000, 10000, 20000, 40000, inf]");
  text.replace(text.find("[0.25, 1]"), 9, "[0.25, 0.35, 0.5, 0.7, 1]");
  const absl::StatusOr<Campaign> dense_campaign = ParseCampaign(text);
  ASSERT_TRUE(dense_campaign.ok()) << dense_campaign.status();
  const absl::StatusOr<InterpolationError> dense = MeasureInterpolationError(*dense_campaign);
  ASSERT_TRUE(dense.ok()) << dense.status();
  EXPECT_LT(dense->thu[200], 0.5 * coarse->thu[200]);  // medians
}

}  // namespace
}  // namespace albtpu
