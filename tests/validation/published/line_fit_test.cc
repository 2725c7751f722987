#include "validation/published/line_fit.h"

#include <gtest/gtest.h>

namespace albtpu {
namespace {

TEST(LineFit, GoesThroughPointsOnALine) {
  const LineFit line = FitLine({1, 2, 4}, {5, 7, 11});
  EXPECT_NEAR(line.slope, 2, 1e-12);
  EXPECT_NEAR(line.intercept, 3, 1e-12);
  EXPECT_NEAR(line.r_squared, 1, 1e-12);
  EXPECT_NEAR(line(10), 23, 1e-12);
}

TEST(LineFit, SaysWhatItDoesNotExplain) {
  const LineFit line = FitLine({0, 1, 2, 3}, {0, 1, 1, 0});  // symmetric: no slope
  EXPECT_NEAR(line.slope, 0, 1e-12);
  EXPECT_NEAR(line.r_squared, 0, 1e-12);
  EXPECT_NEAR(FitLine({0, 1, 2}, {0, 2, 1}).r_squared, 0.25, 1e-12);  // r = 1/2
}

TEST(PowerLaw, IsFoundFromItsOwnPoints) {
  const PowerLaw law = FitPowerLaw({0.25, 1, 4}, {0.6, 0.3, 0.15});
  EXPECT_NEAR(law.factor, 0.3, 1e-12);
  EXPECT_NEAR(law.exponent, -0.5, 1e-12);
}

}  // namespace
}  // namespace albtpu
