#include <gtest/gtest.h>

#include "sea/response/slope_covariance.h"
#include "sea/sea_state.h"
#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

// All but 1e-4 of the slope lies in the energetic range, of which the wavenumbers of seas leave out the waves below 2
// mm.
TEST(SlopeSpectrum, HasTheSlopesOfTheSea) {
  for (const SpectrumModel* model : kSpectrumModels) {
    const Eigen::Matrix2d exact =
        SlopeCovariance(SeaState(SeaOptions{.waves = WindSea{.wind_speed_10m = 8, .model = model}}));
    const Eigen::Matrix2d ours = SlopeSpectrum(WindSeaOf(8, *model)).Covariance();
    EXPECT_LT((ours - exact).norm(), 5e-4 * exact.norm()) << model->key;
  }
}

TEST(SlopeSpectrum, HasTheSlopesOfCrossingWaves) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  ForEachWave(CrossingSea(), 16,
              [&](double variance, const Eigen::Vector2d& k) { sum += variance * k * k.transpose(); });
  EXPECT_LT((SlopeSpectrum(CrossingSea()).Covariance() - sum).norm(), 1e-12);
}

TEST(SlopeSpectrum, IsInterpolatedBetweenTheSamplesOfAnother) {
  HarmonicSpectrum coarse{{0.5, 1, 2}, {1, 2, 0}, {{0.2, 0.2, 0.2}}, {{0, 0, 0}}};
  const Eigen::Matrix2d slopes = SlopeSpectrum(coarse).Covariance();
  // Integrals of S k^2 of the two straight lines: 2 k from 0.5 to 1, 4 - 2 k from 1 to 2. Trapezoids of 5 % and the cut
  // at 0.5 err by half a step there.
  const double mean_square = (1 - 0.0625) / 2 + 4 * 7 / 3.0 - (16 - 1) / 2.0;
  EXPECT_NEAR(slopes.trace(), mean_square, 0.5 * 0.05 * 0.25);
  EXPECT_NEAR(slopes(0, 0) / slopes(1, 1), 1.2 / 0.8, 1e-12);
}

// At nadir the coordinates across the beam are those of the water, turned by the azimuth.
TEST(BeamSpectrum, IsThatOfTheSeaAtNadir) {
  const SlopeSpectrum sea(CrossingSea());
  const BeamSpectrum straight = sea.AcrossBeam(0, 0), turned = sea.AcrossBeam(0, 0.7);
  for (int m = 0; m <= straight.harmonics(); ++m) {
    const std::complex<double> turn = std::polar(1.0, 2 * m * 0.7);
    EXPECT_LT((straight.slope.col(m) * turn - turned.slope.col(m)).norm(), 1e-12) << m;
  }
  EXPECT_NEAR(straight.slope.col(0).sum().real(), sea.Covariance().trace(), 1e-12);
  EXPECT_NEAR(straight.slope.col(1).sum().real(), sea.Covariance()(0, 0) - sea.Covariance()(1, 1), 1e-12);
  EXPECT_NEAR(-straight.slope.col(1).sum().imag(), 2 * sea.Covariance()(0, 1), 1e-12);
}

// kappa = (k along / cos(incidence), k across), for each wave of a fine grid.
TEST(BeamSpectrum, CountsWavesByTheirWavenumberAcrossTheBeam) {
  constexpr double kIncidence = 0.5, kAzimuth = 0.4;
  const HarmonicSpectrum swell = Swell(0.02, 0.5, 1.0, 0.7, 0.3);
  const BeamSpectrum spectrum = SlopeSpectrum(swell).AcrossBeam(kIncidence, kAzimuth);
  std::vector<std::complex<double>> sums(spectrum.harmonics() + 1);
  double height = 0, height_here = 0;
  ForEachWave(swell, 256, [&](double variance, const Eigen::Vector2d& k) {
    const double along = (k.x() * std::cos(kAzimuth) + k.y() * std::sin(kAzimuth)) / std::cos(kIncidence);
    const double across = k.y() * std::cos(kAzimuth) - k.x() * std::sin(kAzimuth);
    const double squared = along * along + across * across, psi = std::atan2(across, along);
    height += variance;
    for (std::size_t m = 0; m < sums.size(); ++m) sums[m] += variance * squared * std::polar(1.0, -2.0 * m * psi);
  });
  const Eigen::ArrayXd k = HankelLattice::Shared().wavenumbers();
  height_here = (spectrum.slope.col(0).real().array() / k.square()).sum();
  EXPECT_NEAR(height_here / height, 1, 1e-4);
  for (std::size_t m = 0; m < sums.size(); ++m)
    EXPECT_LT(std::abs(spectrum.slope.col(m).sum() - sums[m]), 1e-4 * sums[0].real()) << m;
}

}  // namespace
}  // namespace albtpu
