#include <gtest/gtest.h>

#include <cmath>

#include "validation/studies/corrected_waves_study.h"

namespace albtpu {
namespace {

TEST(StandardErrors, FollowTheNormalDistribution) {
  EXPECT_NEAR(StandardErrorsFor(1), 1.95996, 1e-4);    // 5 % for one
  EXPECT_NEAR(StandardErrorsFor(1000), 4.0556, 1e-3);  // 5e-5 for each
}

TEST(AllowedDeparture, GrowsWithSlopeAndIncidence) {
  EXPECT_DOUBLE_EQ(AllowedDeparture(0, 0), 0.015);
  EXPECT_DOUBLE_EQ(AllowedDeparture(0.1, 20), 0.065);
}

TEST(Excess, MeasuresTheDistanceBeyondTheBoundInStandardErrors) {
  EXPECT_NEAR(ExcessInStandardErrors({0.90, 0.01}, 0.07), 3, 1e-9);
  EXPECT_LT(ExcessInStandardErrors({0.99, 0.01}, 0.07), 0);
}

// The nonlinearity of Snell's law only lowers the ratio: above 1 the bound does not grow with slope.
TEST(Excess, AllowsOnlyTheDiscretizationErrorAboveTheClosedForm) {
  EXPECT_NEAR(ExcessInStandardErrors({1.03 + kDiscretizationError, 0.01}, 0.07), 3, 1e-9);
  EXPECT_LT(ExcessInStandardErrors({1 + kDiscretizationError / 2, 0.01}, 0.07), 0);
}

TEST(ClosedFormRatio, IsNearOneAndHasNoTvuAtNadir) {
  SeaCase sea_case;
  sea_case.sea.waves = WindSea{.wind_speed_10m = 3};
  sea_case.beams = {{.footprint = 0.5}, {.incidence = 0.35, .footprint = 0.5}};
  sea_case.depths = {5};
  const SeaCaseRatios ratios = CompareWithClosedForm(sea_case, 64, 1, 0);
  ASSERT_EQ(ratios.beams.size(), 2u);
  for (const ClosedFormRatio& beam : ratios.beams) {
    EXPECT_LE(ExcessInStandardErrors(beam.along, beam.allowed), 4);
    EXPECT_LE(ExcessInStandardErrors(beam.thu, beam.allowed), 4);
  }
  EXPECT_TRUE(std::isnan(ratios.beams[0].tvu.value));
  EXPECT_TRUE(std::isfinite(ratios.beams[1].tvu.value));
  EXPECT_GT(ratios.seen_fraction, kMinSeenFraction);
  EXPECT_LT(ratios.seen_fraction, 1);
}

}  // namespace
}  // namespace albtpu
