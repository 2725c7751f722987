#include "generator/math/forward_fft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "generator/math/inverse_fft.h"

namespace albtpu {
namespace {

TEST(ForwardFft, IsTheSumOverThePoints) {
  constexpr int kSize = 6;
  Eigen::MatrixXd weights(kSize, kSize);
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j < kSize; ++j) weights(i, j) = std::sin(1.0 + 3 * i + 7 * j);
  }
  const Eigen::MatrixXcd waves = ForwardFft(weights);
  ASSERT_EQ(waves.rows(), kSize);
  ASSERT_EQ(waves.cols(), kSize / 2 + 1);
  for (int row = 0; row < kSize; ++row) {
    for (int j = 0; j <= kSize / 2; ++j) {
      std::complex<double> sum = 0;
      for (int ix = 0; ix < kSize; ++ix) {
        for (int iy = 0; iy < kSize; ++iy) {
          const double turns = static_cast<double>(SignedIndex(row, kSize) * ix + j * iy) / kSize;
          sum += weights(ix, iy) * std::polar(1.0, 2 * std::numbers::pi * turns);
        }
      }
      EXPECT_NEAR(std::abs(waves(row, j) - sum), 0, 1e-13) << row << ' ' << j;
    }
  }
}

}  // namespace
}  // namespace albtpu
