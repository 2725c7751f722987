#include "generator/math/fft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace albtpu {
namespace {

TEST(FastSize, IsEvenAndHasNoPrimeFactorAboveFive) {
  EXPECT_EQ(FastSize(1.5), 2);
  EXPECT_EQ(FastSize(11), 12);
  EXPECT_EQ(FastSize(12), 12);
  EXPECT_EQ(FastSize(13), 16);    // 14 = 2 * 7
  EXPECT_EQ(FastSize(433), 450);  // the even sizes from 434 to 448 have larger prime factors
}

TEST(SignedIndex, CountsTheUpperHalfOfTheRowsFromZeroDownwards) {
  EXPECT_EQ(SignedIndex(0, 12), 0);
  EXPECT_EQ(SignedIndex(6, 12), 6);
  EXPECT_EQ(SignedIndex(7, 12), -5);
  EXPECT_EQ(SignedIndex(11, 12), -1);
}

// Heights of the single wave with i cycles along x and j along y, a quarter of a cycle ahead.
void ExpectOneWave(int i, int j) {
  constexpr int kSize = 12;
  const InverseFft transform(kSize);
  InverseFft::Modes modes = transform.Allocate();
  std::fill_n(modes.get(), kSize * (kSize / 2 + 1), 0.0);
  const auto mode = [&](int row, int column) -> std::complex<double>& {
    return modes[(row + kSize) % kSize * (kSize / 2 + 1) + column];
  };
  mode(i, j) = {0, 0.5};
  if (j == 0) mode(-i, 0) = {0, -0.5};
  const auto heights = transform(std::move(modes));
  for (int ix = 0; ix < kSize; ++ix)
    for (int iy = 0; iy < kSize; ++iy)
      EXPECT_NEAR(heights[ix * kSize + iy], -std::sin(2 * std::numbers::pi * (i * ix + j * iy) / kSize), 1e-14);
}

TEST(InverseFft, TurnsOneModeIntoOneWave) {
  ExpectOneWave(2, 3);
  ExpectOneWave(-1, 4);
  ExpectOneWave(3, 0);
}

TEST(ForwardFft, EqualsTheDirectSumOverThePoints) {
  constexpr int kSize = 6;
  Eigen::MatrixXd weights(kSize, kSize);
  for (int i = 0; i < kSize; ++i)
    for (int j = 0; j < kSize; ++j) weights(i, j) = std::sin(1.0 + 3 * i + 7 * j);
  const Eigen::MatrixXcd waves = ForwardFft(weights);
  ASSERT_EQ(waves.rows(), kSize);
  ASSERT_EQ(waves.cols(), kSize / 2 + 1);
  for (int row = 0; row < kSize; ++row) {
    for (int j = 0; j <= kSize / 2; ++j) {
      std::complex<double> sum = 0;
      for (int ix = 0; ix < kSize; ++ix) {
        for (int iy = 0; iy < kSize; ++iy) {
          const double cycles = static_cast<double>(SignedIndex(row, kSize) * ix + j * iy) / kSize;
          sum += weights(ix, iy) * std::polar(1.0, 2 * std::numbers::pi * cycles);
        }
      }
      EXPECT_NEAR(std::abs(waves(row, j) - sum), 0, 1e-13) << row << ' ' << j;
    }
  }
}

}  // namespace
}  // namespace albtpu
