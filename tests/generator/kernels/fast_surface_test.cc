#include "generator/kernels/fast_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace albtpu {
namespace {

// For a vertical beam, SeaSurface is about the same point as FastSurface.
TEST(FastSurface, EqualsTheDoubleTwinUnderAVerticalBeam) {
  const SeaState sea(9, std::numeric_limits<double>::infinity());
  const BeamOptions widest{.incidence = 0.4, .azimuth = 0.3, .footprint = 0.5};
  const SurfaceModel model(sea, widest, {.patch_per_beam = 2.5, .points_per_footprint = 64, .rays = 1});
  const FastSurface surface(model);
  const Beam vertical({.footprint = 0.5}, 1);
  FastSurface::Workspace workspace;
  for (const std::uint32_t realization : {0, 1, 2}) {
    const NormalStream stream(3, 1, realization);
    const HeightField twin = SeaSurface(model, stream).SurfaceUnder(vertical).heights;
    surface.Draw(stream, workspace);
    ASSERT_EQ(workspace.heights.size(), twin.heights().size());
    double farthest = 0;
    for (std::size_t i = 0; i < twin.heights().size(); ++i)
      farthest = std::max(farthest, std::abs(workspace.heights[i] - twin.heights()[i]));
    NormalStream again = stream;
    const Eigen::VectorXcd amplitudes = model.long_waves().Draw(again);
    // The error of a sum in single precision is a few roundings of the sum of magnitudes.
    EXPECT_LT(farthest, 4 * 0x1p-24 * amplitudes.cwiseAbs().sum());

    const auto elevation = [&](const Eigen::Vector2d& x) {
      return model.long_waves().Shifted(amplitudes, x).real().sum();
    };
    constexpr double kStep = 1e-4;  // m
    for (const int axis : {0, 1}) {
      const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(axis);
      EXPECT_NEAR(workspace.long_slope[axis], (elevation(step) - elevation(-step)) / (2 * kStep), 1e-6);
    }
  }
}

}  // namespace
}  // namespace albtpu
