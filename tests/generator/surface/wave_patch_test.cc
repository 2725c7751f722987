#include "generator/surface/wave_patch.h"

#include <gtest/gtest.h>

#include <limits>

namespace albtpu {
namespace {

constexpr double kPi = std::numbers::pi;
const auto kAllWaves = [](double, double) { return 1.0; };

SeaState Sea() { return SeaState(5, std::numeric_limits<double>::infinity()); }

// Gives the patch all waves that its lattice can hold.
CrossFade AllPatch() { return CrossFade(1e-9, 2e-9); }

TEST(CrossFade, GivesLongWavesToThePlaneWavesAndShortOnesToThePatch) {
  const CrossFade share(3, 6);
  EXPECT_EQ(share(0.1), 0);
  EXPECT_EQ(share(3), 0);
  EXPECT_EQ(share(6), 1);
  EXPECT_EQ(share(1000), 1);
}

TEST(CrossFade, RisesSteadilyThroughOneHalfAtTheGeometricMean) {
  const CrossFade share(2, 8);
  EXPECT_NEAR(share(4), 0.5, 1e-15);
  for (double k = 2; k < 8; k *= 1.05) EXPECT_LT(share(k), share(k * 1.05));
}

// The slow twin of Draw: the same normals, two for each mode of the half plane, each row from its own part of the
// stream, and a direct sum over the modes.
std::vector<double> SlowDraw(const SeaState& sea, double length, int size, const CrossFade& share,
                             const NormalStream& stream) {
  const int half = size / 2 + 1;
  std::vector<double> normals(2 * half);
  const double dk = 2 * kPi / length;
  std::vector<double> heights(static_cast<std::size_t>(size) * size, 0.0);
  for (int i = -size / 2 + 1; i < size / 2; ++i) {
    stream.Part(i >= 0 ? 2 * i + 1 : -2 * i).Fill(normals);
    for (int j = 0; j < size / 2; ++j) {
      if (j == 0 && i <= 0) continue;  // the mean, and the conjugates of i > 0
      const double k = dk * std::hypot(i, j);
      // Triangles of the side dx have the slopes 2 sin(kx dx / 2) / dx: the wave is drawn higher by their loss.
      const double dx = length / size;
      const double of_triangles = std::hypot(2 / dx * std::sin(dk * i * dx / 2), 2 / dx * std::sin(dk * j * dx / 2));
      const double power = share(k) * sea.Psi(k, std::atan2(j, i)) * dk * dk * std::pow(k / of_triangles, 2);
      const std::complex<double> amplitude =
          std::sqrt(power / 2) * std::complex<double>(normals[2 * j], normals[2 * j + 1]);
      for (int ix = 0; ix < size; ++ix)
        for (int iy = 0; iy < size; ++iy)
          heights[ix * size + iy] += 2 * (amplitude * std::polar(1.0, 2 * kPi * (i * ix + j * iy) / size)).real();
    }
  }
  return heights;
}

TEST(WavePatch, IsTheSumOfItsModes) {
  const SeaState sea = Sea();
  const CrossFade share(3, 40);
  const WavePatchModel model(sea, 2.0, 24, share);
  NormalStream stream(1, 2, 3);
  const std::vector<double> fast = model.Draw(stream);
  const std::vector<double> slow = SlowDraw(sea, 2.0, 24, share, NormalStream(1, 2, 3));
  const double root_mean_square = std::sqrt(model.elevation_variance());
  for (std::size_t i = 0; i < slow.size(); ++i) EXPECT_NEAR(fast[i], slow[i], 1e-12 * root_mean_square);
}

// The amplitude of mode (i, j) of a grid of heights, by a direct sum.
std::complex<double> Mode(const std::vector<double>& heights, int size, int i, int j) {
  std::complex<double> sum = 0;
  for (int ix = 0; ix < size; ++ix)
    for (int iy = 0; iy < size; ++iy)
      sum += heights[ix * size + iy] * std::polar(1.0, -2 * kPi * (i * ix + j * iy) / size);
  return sum / static_cast<double>(size * size);
}

TEST(WavePatch, DrawsTheSameWavesOnAFinerGrid) {
  const SeaState sea = Sea();
  const NormalStream stream(1, 2, 3);
  const std::vector<double> coarse = WavePatchModel(sea, 2.0, 24, AllPatch()).Draw(stream);
  const std::vector<double> fine = WavePatchModel(sea, 2.0, 60, AllPatch()).Draw(stream);
  for (const auto& [i, j] : {std::pair(3, 0), std::pair(-5, 2), std::pair(11, 11), std::pair(0, 7)}) {
    const std::complex<double> amplitude = Mode(coarse, 24, i, j);
    EXPECT_GT(std::abs(amplitude), 0);
    // On the coarser grid, waves are drawn higher to make up for the slope of its triangles.
    const auto side = [](int mode, int size) { return size / kPi * std::sin(kPi * mode / size); };
    const double higher = std::hypot(side(i, 60), side(j, 60)) / std::hypot(side(i, 24), side(j, 24));
    EXPECT_LT(std::abs(higher * Mode(fine, 60, i, j) - amplitude), 1e-9 * std::abs(amplitude)) << i << ", " << j;
  }
}

// The standard error comes from the scatter of the spatial means of the squares over 2000 draws.
TEST(WavePatch, HasTheVariancesOfItsSpectrum) {
  const WavePatchModel model(Sea(), 2.0, 32, AllPatch());
  constexpr int kDraws = 2000;
  const int size = model.size();
  Eigen::Matrix<double, Eigen::Dynamic, 4> moments(kDraws, 4);  // elevation, slopes xx, yy, xy
  for (int draw = 0; draw < kDraws; ++draw) {
    NormalStream stream(1, 0, draw);
    const std::vector<double> heights = model.Draw(stream);
    const auto at = [&](int ix, int iy) { return heights[(ix % size) * size + iy % size]; };
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (int ix = 0; ix < size; ++ix) {
      for (int iy = 0; iy < size; ++iy) {
        const double low = at(ix, iy), x = at(ix + 1, iy), y = at(ix, iy + 1), high = at(ix + 1, iy + 1);
        sum[0] += low * low;
        for (const Eigen::Vector2d& rise : {Eigen::Vector2d(x - low, high - x), Eigen::Vector2d(high - y, y - low)}) {
          const Eigen::Vector2d slope = rise / model.spacing();
          sum.tail<3>() += 0.5 * Eigen::Vector3d(slope.x() * slope.x(), slope.y() * slope.y(), slope.x() * slope.y());
        }
      }
    }
    moments.row(draw) = sum / (size * size);
  }
  const Eigen::Matrix2d slopes = model.FacetSlopeCovariance(kAllWaves);
  const Eigen::Vector4d expected(model.elevation_variance(), slopes(0, 0), slopes(1, 1), slopes(0, 1));
  for (int m = 0; m < 4; ++m) {
    const Eigen::ArrayXd column = moments.col(m).array();
    const double standard_error = std::sqrt((column - column.mean()).square().sum() / (kDraws - 1) / kDraws);
    EXPECT_NEAR(column.mean(), expected[m], 4 * standard_error) << "moment " << m;
  }
}

// The slopes of the triangles are those of the waves, whether these span many points of the grid or two.
TEST(WavePatch, HasTheMeanSquareSlopeOfItsWavesOnItsTriangles) {
  const SeaState sea = Sea();
  const double length = 2, dk = 2 * kPi / length;
  const int size = 32;
  double slopes = 0;
  for (int i = -size / 2 + 1; i < size / 2; ++i) {
    for (int j = -size / 2 + 1; j < size / 2; ++j) {
      const double k = dk * std::hypot(i, j);
      if (k > 0) slopes += sea.Psi(k, std::atan2(j, i)) * dk * dk * k * k;
    }
  }
  const WavePatchModel model(sea, length, size, AllPatch());
  EXPECT_NEAR(model.FacetSlopeCovariance(kAllWaves).trace() / slopes, 1, 1e-12);
}

// A patch much longer than its waves on a grid much finer holds them all: the sum over the lattice is the integral.
TEST(WavePatch, HoldsTheWholeSeaWhenWideAndFineEnough) {
  const SeaState sea(2, 100);  // peak at 0.3 m
  const double length = 10 * 2 * kPi / sea.spectrum().peak_wavenumber();
  const WavePatchModel model(sea, length, 512, AllPatch());
  EXPECT_NEAR(model.elevation_variance() / ElevationVariance(sea), 1, 0.01);
}

TEST(WavePatch, LeavesOutTheLongWaves) {
  const WavePatchModel all(Sea(), 2.0, 32, AllPatch()), short_waves(Sea(), 2.0, 32, CrossFade(9, 19));
  EXPECT_LT(short_waves.elevation_variance(), all.elevation_variance());
  const auto short_only = [](double k, double) { return k >= 19 ? 1.0 : 0.0; };
  EXPECT_DOUBLE_EQ(short_waves.FacetSlopeCovariance(short_only).trace(), all.FacetSlopeCovariance(short_only).trace());
}

}  // namespace
}  // namespace albtpu
