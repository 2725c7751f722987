#include "tests/generator/kernels/normal_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/instruction_sets.h"

namespace albtpu {
namespace {

constexpr double kUnit = 0x1p-24;  // half a unit in the last place of 1

std::vector<float> Normals(const NormalStream& stream, int count) {
  std::vector<float> normals(count);
  FillInSinglePrecision(stream, normals);
  return normals;
}

std::vector<double> DoubleNormals(NormalStream stream, int count) {
  std::vector<double> normals(count);
  stream.Fill(normals);
  return normals;
}

class NormalLanes : public testing::OnInstructionSet {};
ALBTPU_ON_EACH_INSTRUCTION_SET(NormalLanes);

// Their moments are those of the double stream (random_stream_test.cc).
TEST_P(NormalLanes, EqualTheDoubleStreamWithinTheDerivedError) {
  constexpr int kCount = 2'000'000;
  const NormalStream stream(0x123456789abcdef, 2, 3, 5);
  const std::vector<double> exact = DoubleNormals(stream, kCount);
  const std::vector<float> normals = Normals(stream, kCount);
  double worst = 0, greatest = 0;
  for (int i = 0; i < kCount; ++i) {
    greatest = std::max<double>(greatest, std::abs(normals[i]));
    const double radius = std::hypot(exact[i], exact[i ^ 1]);
    const double bound = 6 * radius + (radius > 1 ? 2 / radius : 0);  // as normal_lanes-inl.h derives it
    worst = std::max(worst, std::abs(normals[i] - exact[i]) / (bound * kUnit));
  }
  EXPECT_LT(worst, 1);
  // None of 2e6 numbers exceeds 4.5 with a probability of only 1e-6 = exp(-2e6 P); none can exceed 6.8.
  EXPECT_GT(greatest, 4.5);
  EXPECT_LT(greatest, std::sqrt(2 * 33 * std::log(2)));
}

TEST_P(NormalLanes, FillNothingBeyondTheSpan) {
  const NormalStream stream(1, 2, 3);
  const std::vector<float> all = Normals(stream, 100);
  for (int count = 0; count < 100; ++count) {
    std::vector<float> normals(100, -1);
    FillInSinglePrecision(stream, std::span(normals).first(count));
    EXPECT_TRUE(std::equal(normals.begin(), normals.begin() + count, all.begin()));
    EXPECT_TRUE(std::all_of(normals.begin() + count, normals.end(), [](float x) { return x == -1; }));
  }
}

}  // namespace
}  // namespace albtpu
