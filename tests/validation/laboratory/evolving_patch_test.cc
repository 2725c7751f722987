#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <vector>

#include "sea/sea_state.h"
#include "validation/laboratory/virtual_tank.h"
#include "validation/laboratory/wave_staff.h"

namespace albtpu {
namespace {

constexpr double kLength = 0.5;  // m
constexpr int kSize = 16;
constexpr double kStep = 2 * std::numbers::pi / kLength;  // rad/m
constexpr int kRealizations = 3000;

SeaState Sea() { return SeaState(5.25, 30); }

EvolvingPatch Realization(int r) {
  return EvolvingPatch(Sea(), kLength, kSize, NormalStream(7, 0, static_cast<std::uint32_t>(r)));
}

// The amplitude of exp(i (kx x + ky y)) in the heights of a patch, kx and ky being i and j steps.
std::complex<double> Amplitude(const std::vector<double>& heights, int i, int j) {
  std::complex<double> sum = 0;
  for (int ix = 0; ix < kSize; ++ix)
    for (int iy = 0; iy < kSize; ++iy)
      sum += heights[ix * kSize + iy] * std::polar(1.0, -2 * std::numbers::pi * (i * ix + j * iy) / kSize);
  return sum / static_cast<double>(kSize * kSize);
}

// The power of all modes of the patch on a frozen surface.
double VarianceOfModes() {
  const SeaState sea = Sea();
  double variance = 0;
  for (int i = 1 - kSize / 2; i < kSize / 2; ++i) {
    for (int j = 1 - kSize / 2; j < kSize / 2; ++j)
      if (i != 0 || j != 0) variance += sea.Psi(kStep * std::hypot(i, j), std::atan2(j, i)) * kStep * kStep;
  }
  return variance;
}

TEST(EvolvingPatch, HasTheVarianceOfAFrozenSurfaceAtAnyInstant) {
  double sum = 0, sum_of_squares = 0;
  for (int r = 0; r < kRealizations; ++r) {
    double variance = 0;
    for (const double height : Realization(r).HeightsAt(3.7)) variance += height * height / (kSize * kSize);
    sum += variance;
    sum_of_squares += variance * variance;
  }
  const double mean = sum / kRealizations;
  const double error = std::sqrt((sum_of_squares / kRealizations - mean * mean) / kRealizations);
  EXPECT_NEAR(mean, VarianceOfModes(), 4 * error);
  EXPECT_LT(error, 0.03 * mean);
}

// The mean of h(k, t + tau) h*(k, t) is (Psi(k) exp(-i omega tau) + Psi(-k) exp(i omega tau)) / 2 with the
// directional Psi: for tau = 0 the power of a frozen surface; other lags distinguish waves that travel in opposite
// directions.
TEST(EvolvingPatch, HasWavesWithAndAgainstTheWindByTheirSpectrum) {
  constexpr int kModes[][2] = {{1, 0}, {2, 1}, {1, 2}, {0, 3}, {-2, 2}, {-3, 0}, {5, 4}};
  for (const double lag : {0.0, 0.06}) {
    std::vector<std::complex<double>> product(std::size(kModes), 0.0);
    for (int r = 0; r < kRealizations; ++r) {
      const EvolvingPatch patch = Realization(r);
      const auto before = patch.HeightsAt(1.1), after = patch.HeightsAt(1.1 + lag);
      for (std::size_t m = 0; m < std::size(kModes); ++m) {
        const auto [i, j] = kModes[m];
        product[m] += Amplitude(after, i, j) * std::conj(Amplitude(before, i, j));
      }
    }
    for (std::size_t m = 0; m < std::size(kModes); ++m) {
      const auto [i, j] = kModes[m];
      const double k = kStep * std::hypot(i, j), psi = std::atan2(j, i);
      const double cell = Sea().S(k) / k * kStep * kStep;
      const double forth = cell * Sea().spectrum().Spreading(k, psi);
      const double back = cell * Sea().spectrum().Spreading(k, psi + std::numbers::pi);
      const std::complex<double> turn = std::polar(1.0, -AngularFrequency(k) * lag);
      const std::complex<double> expected = 0.5 * (forth * turn + back * std::conj(turn));
      const std::complex<double> found = product[m] / static_cast<double>(kRealizations);
      // |h|^2 is exponentially distributed: the standard error of its mean over N is its value over sqrt(N).
      const double error = 0.5 * (forth + back) / std::sqrt(kRealizations);
      EXPECT_NEAR(found.real(), expected.real(), 4 * error) << i << ", " << j << ", lag " << lag;
      EXPECT_NEAR(found.imag(), expected.imag(), 4 * error) << i << ", " << j << ", lag " << lag;
    }
  }
}

// Cosine-2S spreading has no waves straight against the wind, so a wave straight downwind travels alone.
TEST(EvolvingPatch, MovesASingleWaveDownwindAtItsPhaseSpeed) {
  const EvolvingPatch patch = Realization(0);
  const double lag = 0.031;
  const auto before = patch.HeightsAt(0), after = patch.HeightsAt(lag);
  for (int i = 1; i < kSize / 2; ++i) {
    const double k = i * kStep;
    const double way = AngularFrequency(k) / k * lag;  // m downwind: the phase decreases by k times that
    const std::complex<double> moved = Amplitude(before, i, 0) * std::polar(1.0, -k * way);
    EXPECT_LT(std::abs(Amplitude(after, i, 0) - moved), 1e-9 * std::abs(moved)) << i;
  }
}

TEST(EvolvingPatch, IsAFunctionOfItsStream) {
  EXPECT_EQ(Realization(5).HeightsAt(2), Realization(5).HeightsAt(2));
  EXPECT_NE(Realization(5).HeightsAt(2), Realization(6).HeightsAt(2));
}

}  // namespace
}  // namespace albtpu
