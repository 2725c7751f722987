#include "generator/kernels/normal_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

TEST_P(NormalLanes, EqualTheDoubleStreamWithinTheDerivedError) {
  constexpr int kCount = 4000000;
  const NormalStream stream(0x123456789abcdef, 2, 3, 5);
  const std::vector<double> exact = DoubleNormals(stream, kCount);
  const std::vector<float> normals = Normals(stream, kCount);
  double worst = 0;
  for (int i = 0; i < kCount; ++i) {
    const double radius = std::hypot(exact[i], exact[i ^ 1]);
    const double bound = 6 * radius + (radius > 1 ? 2 / radius : 0);  // as normal_lanes-inl.h derives it
    worst = std::max(worst, std::abs(normals[i] - exact[i]) / (bound * kUnit));
  }
  EXPECT_LT(worst, 1);
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

TEST(NormalsInSinglePrecision, HaveTheMomentsOfTheNormalDistribution) {
  constexpr int kCount = 10000000;
  std::array<double, 7> moment = {};
  double greatest = 0;
  for (const float x : Normals(NormalStream(7, 0, 0), kCount)) {
    double power = 1;
    for (int p = 1; p <= 6; ++p) moment[p] += (power *= x) / kCount;
    greatest = std::max(greatest, std::abs(static_cast<double>(x)));
  }
  // Four standard errors: Var x^p = m_2p - m_p^2 with m_2, m_4, ..., m_12 = 1, 3, 15, 105, 945, 10395.
  EXPECT_NEAR(moment[1], 0, 4 * std::sqrt(1.0 / kCount));
  EXPECT_NEAR(moment[2], 1, 4 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(moment[3], 0, 4 * std::sqrt(15.0 / kCount));
  EXPECT_NEAR(moment[4], 3, 4 * std::sqrt(96.0 / kCount));
  EXPECT_NEAR(moment[5], 0, 4 * std::sqrt(945.0 / kCount));
  EXPECT_NEAR(moment[6], 15, 4 * std::sqrt(10170.0 / kCount));
  // None of 1e7 numbers exceeds 4.8 with a probability of only 1e-7 = exp(-1e7 P); none can exceed 6.8.
  EXPECT_GT(greatest, 4.8);
  EXPECT_LT(greatest, std::sqrt(2 * 33 * std::log(2)));
}

}  // namespace
}  // namespace albtpu
