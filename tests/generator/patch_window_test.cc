#include "generator/patch_window.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/generator/simd_targets.h"

namespace albtpu {
namespace {

// Waves from the whole side of the patch to the spacing of its grid.
WavePatchModel Patch(int size) {
  return WavePatchModel(SeaState(5, std::numeric_limits<double>::infinity()), 2.0, size,
                        CrossFade(1e-9, 2e-9));
}

std::vector<float> Draw(const PatchWindow& window, const NormalStream& stream) {
  std::vector<float> heights(static_cast<std::size_t>(window.points()) * window.points());
  PatchWindow::Workspace workspace;
  window.Draw(stream, heights, workspace);
  return heights;
}

// The heights of the double patch about its first point, of which the patch's other edges are neighbours.
std::vector<double> SlowDraw(const WavePatchModel& patch, int points, const NormalStream& stream) {
  const std::vector<double> heights = patch.Draw(stream);
  const int size = patch.size();
  std::vector<double> window;
  for (int ix = -(points / 2); ix <= points / 2; ++ix) {
    for (int iy = -(points / 2); iy <= points / 2; ++iy) {
      window.push_back(heights[(ix + size) % size * size + (iy + size) % size]);
    }
  }
  return window;
}

// The root mean square of the differences over the window, in standard deviations of the heights.
double Distance(const WavePatchModel& patch, int points, const NormalStream& stream) {
  const std::vector<float> fast = Draw(PatchWindow(patch, points), stream);
  const std::vector<double> slow = SlowDraw(patch, points, stream);
  double squares = 0;
  for (std::size_t i = 0; i < slow.size(); ++i) squares += (fast[i] - slow[i]) * (fast[i] - slow[i]);
  return std::sqrt(squares / static_cast<double>(slow.size()) / patch.elevation_variance());
}

TEST(PatchWindow, IsTheMiddleOfTheSameSurface) {
  // Amplitudes are right to a few 2^-24, and each of the stages of the transform adds less than 2^-24 to each
  // height's relative error: in all well under 2^-20.
  OnEachInstructionSet([] {
    for (const int size : {4, 6, 10, 18, 48, 60, 90, 100, 128, 250, 270, 360, 512}) {
      const WavePatchModel patch = Patch(size);
      for (int points : {1, 3, size / 4 * 2 - 1, size - 1}) {
        if (points < size) {
          EXPECT_LT(Distance(patch, points, NormalStream(1, 2, size)), 0x1p-20) << points << " of " << size;
        }
      }
    }
  });
}

}  // namespace
}  // namespace albtpu
