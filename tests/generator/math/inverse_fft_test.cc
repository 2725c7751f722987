#include "generator/math/inverse_fft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace albtpu {
namespace {

constexpr int kSize = 12;

// Heights of the one wave with i turns along x and j along y, and a quarter turn ahead.
void ExpectAWave(int i, int j) {
  const InverseFft transform(kSize);
  InverseFft::Modes modes = transform.Allocate();
  std::fill_n(modes.get(), kSize * (kSize / 2 + 1), 0.0);
  const auto at = [&](int row, int column) -> std::complex<double>& {
    return modes[(row + kSize) % kSize * (kSize / 2 + 1) + column];
  };
  at(i, j) = {0, 0.5};
  if (j == 0) at(-i, 0) = {0, -0.5};
  const auto heights = transform(std::move(modes));
  for (int ix = 0; ix < kSize; ++ix) {
    for (int iy = 0; iy < kSize; ++iy) {
      EXPECT_NEAR(heights[ix * kSize + iy], -std::sin(2 * std::numbers::pi * (i * ix + j * iy) / kSize),
                  1e-14);
    }
  }
}

TEST(InverseFft, MakesAWaveOfAMode) {
  ExpectAWave(2, 3);
  ExpectAWave(-1, 4);
  ExpectAWave(3, 0);
}

TEST(InverseFft, CountsModesFromTheMiddle) {
  EXPECT_EQ(SignedIndex(0, kSize), 0);
  EXPECT_EQ(SignedIndex(6, kSize), 6);
  EXPECT_EQ(SignedIndex(7, kSize), -5);
  EXPECT_EQ(SignedIndex(11, kSize), -1);
}

}  // namespace
}  // namespace albtpu
