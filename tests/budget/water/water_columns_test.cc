#include "budget/water/water_columns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sea/angle.h"
#include "tests/budget/water/known_waters.h"
#include "tests/tables/water/shipped_water.h"

namespace albtpu {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Column = std::vector<float>;

CompiledWater Compile(const KnownWater& water) {
  absl::StatusOr<CompiledWater> compiled = CompileWater(testing::ShippedWaterTable().get(), water);
  EXPECT_TRUE(compiled.ok()) << compiled.status();
  return *std::move(compiled);
}

WaterBatch At(const CompiledWater& water, std::size_t size, const Column& incidence, const Column& depth,
              const Column& footprint) {
  WaterBatch batch;
  ComputeWater(water, 1.34, {.size = size, .incidence = incidence, .depth = depth, .footprint = footprint}, batch);
  return batch;
}

// At nadir a range that was computed with 1.33 is as many times too long as the group index exceeds it.
KnownWater ProcessedWith133() { return {.temperature = 15, .salinity = 35, .processed_with = 1.33}; }

TEST(WaterColumns, HoldOneNumberForAllPulses) {
  KnownWater water = testing::CoastalWater();
  water.photons = 100;
  const CompiledWater compiled = Compile(water);
  const WaterBatch one = At(compiled, 3, {15}, {7}, {0.5}), many = At(compiled, 3, {15, 15, 15}, {7, 7, 7}, {});
  EXPECT_THAT(one.sigma_vertical, Each(one.sigma_vertical[0]));
  EXPECT_EQ(one.sigma_vertical, many.sigma_vertical);
  EXPECT_EQ(one.sigma_along, many.sigma_along);
  EXPECT_EQ(one.correlation, many.correlation);
  EXPECT_EQ(one.noise, many.noise);
  EXPECT_GT(one.noise[2], 0);
}

TEST(WaterColumns, AreEmptyWhereNothingIsToBeAdded) {
  const WaterBatch none = At(Compile({}), 2, {15}, {7}, {0.5});
  EXPECT_THAT(none.sigma_vertical, IsEmpty());
  EXPECT_THAT(none.bias_vertical, IsEmpty());
  const WaterBatch of_index = At(Compile(ProcessedWith133()), 2, {0}, {10, 5}, {0.5});
  EXPECT_THAT(of_index.sigma_vertical, IsEmpty());
  const double group = SeaWaterIndex(15, 35).group;
  EXPECT_NEAR(of_index.bias_vertical[0], -10 * (group / 1.33 - 1) * 1.33 / group, 2e-3);
  EXPECT_NEAR(of_index.bias_vertical[1], of_index.bias_vertical[0] / 2, 1e-7);
}

TEST(WaterColumns, OfAPulseBeyondHaveTheBiasOfTheIndexAlone) {
  KnownWater water = ProcessedWith133();
  const WaterBatch of_index = At(Compile(water), 4, {10, 40, 10, 10}, {200, 5, 5, 5}, {0.5, 0.5, 3, 0.5});
  water.optics = {.secchi = 5};
  water.field_of_view = 6;
  water.pulse_length = 1.5;
  water.bias = BiasTreatment{};
  water.green_surface = true;
  const WaterBatch beyond = At(Compile(water), 4, {10, 40, 10, 10}, {200, 5, 5, 5}, {0.5, 0.5, 3, 0.5});
  for (std::size_t i = 0; i < 3; ++i) {  // Too deep, too slanted, too wide.
    EXPECT_TRUE(beyond.is_beyond(i));
    EXPECT_EQ(beyond.bias_vertical[i], of_index.bias_vertical[i]);
    EXPECT_EQ(beyond.bias_along[i], of_index.bias_along[i]);
  }
  EXPECT_FALSE(beyond.is_beyond(3));
  EXPECT_LT(beyond.bias_vertical[3], of_index.bias_vertical[3]);
}

TEST(WaterColumns, SumTheBiases) {
  KnownWater all = ProcessedWith133();
  all.optics = {.secchi = 5};
  all.field_of_view = 6;
  all.pulse_length = 1.5;
  all.bias = BiasTreatment{};
  all.green_surface = true;
  const CompiledWater compiled = Compile(all);
  const WaterBatch sum = At(compiled, 1, {15}, {6}, {0.5});
  const double theta = RadiansOfDegrees(15);
  const WaterAnswerOfSurvey scattering = *compiled.share->At(15, 6);
  const IndexBias index = BiasOfIndex(theta, SeaWaterIndex(15, 35), 1.33);
  const ShiftBySurface shift = ShiftBySurfaceOf(theta, 1.34);
  EXPECT_NEAR(sum.bias_vertical[0], scattering.bias_vertical + 6 * index.vertical - shift.down * compiled.surface->mean,
              1e-6);
  EXPECT_NEAR(sum.bias_along[0], scattering.bias_along + 6 * index.along + shift.along * compiled.surface->mean, 1e-6);
  EXPECT_NEAR(sum.sigma_vertical[0], std::hypot(scattering.left_vertical, shift.down * compiled.surface->unknown),
              1e-6);
}

// The height at which a surface was located is another error, whose size does not matter.
TEST(AddGreenSpread, AddsToTheRangeOfTheSurface) {
  const GreenSurface surface{.spread = 0.04};
  for (const double height : {0.0, 1e-6, 0.1}) {
    AirErrors errors{.surface_range = 0.03, .surface_height = height};
    AddGreenSpread(surface, SurfaceLocation::kPulse, errors);
    EXPECT_NEAR(errors.surface_range, 0.05, 1e-12);
    EXPECT_EQ(errors.surface_height, height);
  }
  AirErrors errors{.surface_range = 0.03};
  AddGreenSpread(surface, SurfaceLocation::kLocal, errors);
  EXPECT_EQ(errors.surface_range, 0.03);
}

TEST(KnownWater, SaysWhatCannotBeCompiled) {
  const auto problem = [](const KnownWater& water) {
    const absl::Status status = CompileWater(testing::ShippedWaterTable().get(), water).status();
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
    return std::string(status.message());
  };
  EXPECT_THAT(problem({.temperature = 15}), HasSubstr("temperature and salinity go together"));
  EXPECT_THAT(problem({.processed_with = 1.33}), HasSubstr("needs the index that the water has"));
  EXPECT_THAT(problem({.photons = 100}), HasSubstr("photons have no effect without a bias treatment"));
  EXPECT_THAT(problem({.green_surface = true}), HasSubstr("nothing says how clear the water is"));
  EXPECT_THAT(problem(testing::CoastalWater({.secchi = 60})), HasSubstr("clearer than pure water"));
  KnownWater centroid = testing::CoastalWater();
  centroid.detector = EchoDetector::kCentroid;
  centroid.green_surface = true;
  EXPECT_THAT(problem(centroid), HasSubstr("centroid"));
}

TEST(KnownWater, ListsWhatWasAssumed) {
  const auto assumptions = [](const KnownWater& water) { return AssumptionsOf(water, Compile(water)); };
  EXPECT_THAT(
      assumptions(testing::CoastalWater({.kd = 0.2, .kd_kind = KdKind::kDiffuse532})),
      ElementsAre("The attenuation is known to 10 % (1 sigma), which is what kd of kind diffuse532 is good for.",
                  "The single-scattering albedo is 0.8, as that of coastal water.",
                  "The albedo is known to 0.1 (1 sigma).",
                  "The backscatter fraction is between 0.01 and 0.03, as that of natural particles.",
                  "The group index of the water is that of sea water, 1.3643.",
                  "The ranges in water were computed with the group index of the water.",
                  "The noise of the photons of an echo is in the error of the range to the bottom."));
  KnownWater known =
      testing::CoastalWater({.absorption = 0.1, .scattering = 0.4, .kd_sigma = 0.01, .backscatter_fraction = 0.02});
  known.temperature = 10;
  known.salinity = 30;
  known.processed_with = 1.34;
  known.photons = 100;
  EXPECT_THAT(assumptions(known), IsEmpty());
  known = testing::CoastalWater({.kd = 0.4, .kd_kind = KdKind::kDiffuse532, .omega0 = 0.9, .omega0_sigma = 0.1});
  EXPECT_THAT(assumptions(known),
              ::testing::Contains("The albedo is no larger than in the table of the water column: 19 % of the waters "
                                  "that were stated lie beyond, and are left out."));
}

}  // namespace
}  // namespace albtpu
