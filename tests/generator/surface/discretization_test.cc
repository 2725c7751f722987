#include "generator/surface/discretization.h"

#include <gtest/gtest.h>

#include <limits>

#include "sea/spectra/wind_sea.h"

namespace albtpu {
namespace {

TEST(WidestBeam, HasTheGreatestIncidence) {
  EXPECT_EQ(WidestBeam({{.incidence = 0.1}, {.incidence = 0.4, .azimuth = 1}, {.incidence = 0.2}}).azimuth, 1);
}

TEST(Discretization, SufficesForEveryBeamOnTheSurface) {
  const SeaState sea(4, 1e3);
  const std::vector<BeamOptions> beams = {{.incidence = 0, .footprint = 1},
                                          {.incidence = 0.44, .azimuth = 0.8, .footprint = 1},
                                          {.incidence = 0.44, .azimuth = 1.5, .footprint = 1}};
  const SurfaceModel model(sea, WidestBeam(beams), ChooseDiscretization(sea, beams));
  EXPECT_GE(FootprintSlopeFraction(sea, model, beams), 0.99);
}

// A footprint much wider than the waves averages them out except near its edge. Resolving the remainder takes a finer
// grid and more rays.
TEST(Discretization, IsFinerUnderAFootprintMuchWiderThanTheWaves) {
  const SeaState young(3, 100);
  const Discretization narrow = ChooseDiscretization(young, {{.footprint = 0.1}});
  const Discretization wide = ChooseDiscretization(young, {{.footprint = 2}});
  EXPECT_GT(wide.points_per_footprint, narrow.points_per_footprint);
  EXPECT_GE(wide.rays, narrow.rays);
}

TEST(Discretization, IsCoarseUnderAFootprintMuchNarrowerThanTheWaves) {
  const Discretization choice = ChooseDiscretization(SeaState(10, kFullyDeveloped), {{.footprint = 0.5}});
  EXPECT_LE(choice.points_per_footprint, 64);
  EXPECT_LE(choice.rays, 4000);
}

}  // namespace
}  // namespace albtpu
