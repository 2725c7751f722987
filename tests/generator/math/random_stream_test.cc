#include "generator/math/random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace albtpu {
namespace {

std::vector<double> Normals(NormalStream stream, int count) {
  std::vector<double> normals(count);
  stream.Fill(normals);
  return normals;
}

double Correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum / static_cast<double>(a.size());
}

TEST(NormalStream, IsPhiloxWithTheTransformOfBoxAndMuller) {
  // Random123's known answer for philox4x32-10 with a counter and a key of zeros.
  constexpr std::array<std::uint32_t, 4> kWords = {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8};
  const std::vector<double> normals = Normals(NormalStream(0, 0, 0), 4);
  for (int pair = 0; pair < 2; ++pair) {
    const double radius = std::sqrt(-2 * std::log((kWords[2 * pair] + 0.5) / 4294967296));
    const double angle = 2 * std::numbers::pi * kWords[2 * pair + 1] / 4294967296;
    EXPECT_NEAR(normals[2 * pair], radius * std::cos(angle), 1e-14);
    EXPECT_NEAR(normals[2 * pair + 1], radius * std::sin(angle), 1e-14);
  }
}

TEST(NormalStream, IsReproducible) {
  EXPECT_EQ(Normals(NormalStream(1, 2, 3), 101), Normals(NormalStream(1, 2, 3), 101));
}

TEST(NormalStream, ContinuesAtTheNextMultipleOfFourNumbers) {
  const std::vector<double> whole = Normals(NormalStream(1, 2, 3), 16);
  NormalStream stream(1, 2, 3);
  std::vector<double> first(6), second(8);
  stream.Fill(first);
  stream.Fill(second);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), whole.begin()));
  EXPECT_TRUE(std::equal(second.begin(), second.end(), whole.begin() + 8));
}

TEST(NormalStream, HasTheMomentsOfTheNormalDistribution) {
  constexpr int kCount = 10000000;
  std::array<double, 7> moment = {};
  for (const double x : Normals(NormalStream(7, 0, 0), kCount)) {
    double power = 1;
    for (int p = 1; p <= 6; ++p) moment[p] += (power *= x) / kCount;
  }
  // Four standard errors: Var x^p = m_2p - m_p^2 with m_2, m_4, ..., m_12 = 1, 3, 15, 105, 945, 10395.
  const double expected[] = {0, 1, 0, 3, 0, 15}, variance[] = {1, 2, 15, 96, 945, 10170};
  for (int p = 1; p <= 6; ++p) EXPECT_NEAR(moment[p], expected[p - 1], 4 * std::sqrt(variance[p - 1] / kCount)) << p;
}

TEST(NormalStream, IsUncorrelatedWithOtherStreamsAndWithItselfShifted) {
  constexpr int kCount = 100000;
  const std::vector<double> one = Normals(NormalStream(1, 2, 3), kCount);
  const double four_standard_errors = 4 / std::sqrt(kCount);
  const std::vector<NormalStream> others = {NormalStream(2, 2, 3), NormalStream(1, 3, 3), NormalStream(1, 2, 4),
                                            NormalStream(1, 3, 2), NormalStream(1 + (std::uint64_t{1} << 32), 2, 3)};
  for (const NormalStream& other : others)
    EXPECT_NEAR(Correlation(one, Normals(other, kCount)), 0, four_standard_errors);
  std::vector<double> next = one;
  std::rotate(next.begin(), next.begin() + 1, next.end());
  EXPECT_NEAR(Correlation(one, next), 0, four_standard_errors);
}

}  // namespace
}  // namespace albtpu
