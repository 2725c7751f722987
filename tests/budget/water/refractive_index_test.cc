#include "budget/water/refractive_index.h"

#include <gtest/gtest.h>

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
        (SeaWaterIndex(12, 30, wavelength + step).phase - SeaWaterIndex(12, 30, wavelength - step).phase) /
        (2 * step);
    EXPECT_NEAR(SeaWaterIndex(12, 30, wavelength).group,
                SeaWaterIndex(12, 30, wavelength).phase - wavelength * slope, 1e-8);
  }
}

TEST(SeaWaterIndex, GrowsWithSaltAndFallsWithWarmth) {
  EXPECT_NEAR(SeaWaterIndex(15, 36).group - SeaWaterIndex(15, 35).group, 2.1e-4, 5e-6);
  EXPECT_NEAR(SeaWaterIndex(16, 35).group - SeaWaterIndex(15, 35).group, -0.9e-4, 1e-5);
}

}  // namespace
}  // namespace albtpu
