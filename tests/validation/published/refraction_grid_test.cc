#include "validation/published/refraction_grid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace albtpu {
namespace {

const GridOptions kTwoByTwo = {{3, 5}, {0, 20}};

// One row for each wind, two incidences; along, cross.
RefractionGrid GridOfAngles(double a, double b, double c, double d, double cross) {
  return {kTwoByTwo, {{{a, 0}, {cross, 0}}, {{b, 0}, {cross, 0}}, {{c, 0}, {cross, 0}}, {{d, 0}, {cross, 0}}}};
}

TEST(RefractionGrid, CountsRisingAngles) {
  const RefractionGrid grid = GridOfAngles(2, 3, 2.5, 2, 2.2);
  EXPECT_EQ(AlongWindRisesWithWind(grid).holds, 1);  // at nadir, not at 20 degrees
  EXPECT_EQ(AlongWindRisesWithWind(grid).all, 2);
  EXPECT_EQ(AlongWindRisesWithIncidence(grid).holds, 1);
  EXPECT_EQ(AlongWindExceedsCrossWind(grid).holds, 2);
  EXPECT_EQ(AlongWindExceedsCrossWind(grid).all, 4);
}

TEST(RefractionGrid, ComparesCleanCellsOnly) {
  const PublishedAngles paper{{3, 5}, {0, 20}, {{2, 1}, {2, 1}, {2, 1, true, false}, {99, 1, false, true}}};
  const LogRatio along = AlongWindLogRatio(GridOfAngles(1, 2, 4, 8, 2), 1, paper);
  EXPECT_NEAR(along.mean, 0, 1e-12);  // ln of 1/2, 1, 2
  EXPECT_NEAR(along.rms, std::log(2) * std::sqrt(2.0 / 3), 1e-12);
  EXPECT_NEAR(std::abs(along.greatest), std::log(2), 1e-12);
  EXPECT_NEAR(CrossWindLogRatio(GridOfAngles(1, 2, 4, 8, 2), 0.5, paper).rms, 0, 1e-12);
}

TEST(RefractionGrid, ScalesWithWaveHeightInTheClosedForm) {
  GridOptions higher = kTwoByTwo;
  higher.height_scale = 2;
  const RefractionGrid once = ClosedFormGrid(kTwoByTwo), twice = ClosedFormGrid(higher);
  for (std::size_t c = 0; c < once.cells.size(); ++c) {
    EXPECT_NEAR(twice.cells[c].along.value / once.cells[c].along.value, 2, 1e-9);
    EXPECT_NEAR(twice.cells[c].cross.value / once.cells[c].cross.value, 2, 1e-9);
  }
}

TEST(RefractionGrid, OfTracedBeamsAgreesWithTheClosedForm) {
  const RefractionGrid theory = ClosedFormGrid(kTwoByTwo);
  const RefractionGrid ours = SimulateGrid(kTwoByTwo, {64, 1000, Estimator::kControlVariate}, 1);
  ASSERT_EQ(ours.cells.size(), theory.cells.size());
  for (std::size_t c = 0; c < ours.cells.size(); ++c) {
    EXPECT_NEAR(ours.cells[c].along.value / theory.cells[c].along.value, 1,
                0.05 + 4 * ours.cells[c].along.standard_error / theory.cells[c].along.value);
  }
  EXPECT_GT(LargestRelativeStandardError(ours), 0);
}

}  // namespace
}  // namespace albtpu
