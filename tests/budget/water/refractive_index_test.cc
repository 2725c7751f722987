#include "budget/water/refractive_index.h"

#include <gtest/gtest.h>

#include <cmath>

namespace albtpu {
namespace {

// Evaluated by hand from the published equation, to the printed digits.
TEST(SeaWaterIndex, HasTheValuesOfQuanAndFry) {
  EXPECT_NEAR(SeaWaterIndex(15, 0).phase, 1.33543, 5e-6);
  EXPECT_NEAR(SeaWaterIndex(15, 0).group, 1.35699, 5e-6);
  EXPECT_NEAR(SeaWaterIndex(15, 35).phase, 1.34199, 5e-6);
  EXPECT_NEAR(SeaWaterIndex(15, 35).group, 1.36432, 5e-6);
  EXPECT_NEAR(SeaWaterIndex(15, 35, 515).phase, 1.34273, 5e-6);
  EXPECT_NEAR(SeaWaterIndex(15, 35, 515).group, 1.36632, 5e-6);
}

TEST(SeaWaterIndex, DelaysAsItsPhaseChangesWithWavelength) {
  for (const double wavelength : {450.0, 532.0, 650.0}) {
    const double step = 0.01;
    const double slope =
        (SeaWaterIndex(12, 30, wavelength + step).phase - SeaWaterIndex(12, 30, wavelength - step).phase) / (2 * step);
    EXPECT_NEAR(SeaWaterIndex(12, 30, wavelength).group, SeaWaterIndex(12, 30, wavelength).phase - wavelength * slope,
                1e-8);
  }
}

TEST(SeaWaterIndex, GrowsWithSaltAndFallsWithWarmth) {
  EXPECT_NEAR(SeaWaterIndex(15, 36).group - SeaWaterIndex(15, 35).group, 2.1e-4, 5e-6);
  EXPECT_NEAR(SeaWaterIndex(16, 35).group - SeaWaterIndex(15, 35).group, -0.9e-4, 1e-5);
}

TEST(BiasOfIndex, IsThatOfARayTracedTwice) {
  for (const double incidence : {0.0, 0.2, 0.35, 0.5}) {
    for (const double used : {1.33, 1.34, 1.3643}) {
      const WaterIndex water = SeaWaterIndex(15, 35);
      // The pulse goes down to 10 m and back; the processing takes its time, its own angle and its own speed.
      const double refracted = std::asin(std::sin(incidence) / water.phase);
      const double ray = 10 / std::cos(refracted);
      const double reported_ray = ray * water.group / used;
      const double reported_angle = std::asin(std::sin(incidence) / used);
      const double reported_depth = reported_ray * std::cos(reported_angle);
      const IndexBias bias = BiasOfIndex(incidence, water, used);
      EXPECT_NEAR(bias.vertical * reported_depth, 10 - reported_depth, 1e-12);
      EXPECT_NEAR(bias.along * reported_depth, reported_ray * std::sin(reported_angle) - ray * std::sin(refracted),
                  1e-12);
    }
  }
  EXPECT_NEAR(10 * BiasOfIndex(0, SeaWaterIndex(15, 35), 1.33).vertical, -0.2515, 1e-4);
}

}  // namespace
}  // namespace albtpu
