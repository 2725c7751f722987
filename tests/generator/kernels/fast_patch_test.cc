#include "generator/kernels/fast_patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/instruction_sets.h"

namespace albtpu {
namespace {

// A patch of all waves from the length of its side to the spacing of its grid.
WavePatchModel Patch(int size) {
  return WavePatchModel(SeaState(5, std::numeric_limits<double>::infinity()), 2.0, size, CrossFade(1e-9, 2e-9));
}

std::vector<float> Draw(const FastPatch& patch, const NormalStream& stream) {
  std::vector<float> heights(static_cast<std::size_t>(patch.points()) * patch.points());
  FastPatch::Workspace workspace;
  patch.Draw(stream, heights, workspace);
  return heights;
}

// The heights of the patch in double precision about its first point, across the periodic boundary.
std::vector<double> SlowDraw(const WavePatchModel& patch, int points, const NormalStream& stream) {
  const std::vector<double> heights = patch.Draw(stream);
  const int size = patch.size();
  std::vector<double> centred;
  for (int ix = -(points / 2); ix <= points / 2; ++ix)
    for (int iy = -(points / 2); iy <= points / 2; ++iy)
      centred.push_back(heights[(ix + size) % size * size + (iy + size) % size]);
  return centred;
}

// The root mean square difference over all points, in standard deviations of the heights.
double Distance(const WavePatchModel& patch, int points, const NormalStream& stream) {
  const std::vector<float> fast = Draw(FastPatch(patch, points), stream);
  const std::vector<double> slow = SlowDraw(patch, points, stream);
  double squares = 0;
  for (std::size_t i = 0; i < slow.size(); ++i) squares += (fast[i] - slow[i]) * (fast[i] - slow[i]);
  return std::sqrt(squares / static_cast<double>(slow.size()) / patch.elevation_variance());
}

class EachFastPatch : public testing::OnInstructionSet {};
ALBTPU_ON_EACH_INSTRUCTION_SET(EachFastPatch);

TEST_P(EachFastPatch, EqualsThePatchOfTheDoubleTwin) {
  // Amplitudes have an error of a few 2^-24, and each stage of the transform adds less than 2^-24 to the relative error
  // of each height: well below 2^-20 in total.
  for (const int size : {4, 6, 10, 18, 48, 60, 90, 100, 128, 250, 270, 360, 512}) {
    const WavePatchModel patch = Patch(size);
    for (int points : {1, 3, size / 4 * 2 - 1, size - 1})
      if (points < size) {
        EXPECT_LT(Distance(patch, points, NormalStream(1, 2, size)), 0x1p-20) << points << " of " << size;
      }
  }
}

TEST_P(EachFastPatch, EqualsThatOfTheUsualInstructionSet) {
  // Instruction sets differ by rounding only.
  const WavePatchModel patch = Patch(128);
  const FastPatch fast(patch, 57);
  const std::vector<float> heights = Draw(fast, NormalStream(1, 2, 3));
  EXPECT_EQ(heights, Draw(fast, NormalStream(1, 2, 3)));
  Choose(0);
  const std::vector<float> usual = Draw(fast, NormalStream(1, 2, 3));
  const double standard_deviation = std::sqrt(patch.elevation_variance());
  for (std::size_t i = 0; i < usual.size(); ++i) EXPECT_NEAR(heights[i], usual[i], 0x1p-19 * standard_deviation);
}

TEST(FastPatch, DoesNotDependOnEarlierUseOfTheWorkspace) {
  const WavePatchModel small = Patch(18), large = Patch(60);
  const FastPatch narrow(small, 5), wide(large, 59);
  FastPatch::Workspace workspace;
  for (int draw = 0; draw < 3; ++draw) {
    const NormalStream stream(1, 2, draw);
    std::vector<float> of_small(5 * 5), of_large(59 * 59);
    narrow.Draw(stream, of_small, workspace);
    wide.Draw(stream, of_large, workspace);
    EXPECT_EQ(of_small, Draw(narrow, stream));
    EXPECT_EQ(of_large, Draw(wide, stream));
  }
}

TEST(FastPatch, DiffersBetweenRealizationsCellsAndSeeds) {
  const WavePatchModel patch = Patch(18);
  const FastPatch fast(patch, 5);
  const std::vector<float> heights = Draw(fast, NormalStream(1, 2, 3));
  EXPECT_NE(heights, Draw(fast, NormalStream(1, 2, 4)));
  EXPECT_NE(heights, Draw(fast, NormalStream(1, 3, 3)));
  EXPECT_NE(heights, Draw(fast, NormalStream(2, 2, 3)));
}

}  // namespace
}  // namespace albtpu
