#include "sea/spectra/binned_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sea/spectra/spectrum_moments.h"
#include "tests/degree.h"
#include "tests/sea/spectra/deep_water.h"

namespace albtpu {
namespace {

using albtpu::testing::kDegree;

BinnedSpectrum Bins(std::vector<double> f, const std::vector<double>& energy, double axis = 0, double r2 = 0.5) {
  std::vector<DirectionalEnergy> bins;
  for (const double each : energy) bins.push_back(SymmetricEnergy(each, {r2}, axis));
  return BinnedSpectrum(std::make_shared<const std::vector<double>>(std::move(f)), bins, 1, 0.4);
}

TEST(BinnedSpectrum, IsLinearBetweenCentresAndZeroBeyond) {
  const BinnedSpectrum spectrum = Bins({0.1, 0.2, 0.4}, {1, 3, 2});
  EXPECT_EQ(spectrum(0.0999).energy, 0);
  EXPECT_EQ(spectrum(0.1).energy, 1);
  EXPECT_NEAR(spectrum(0.125).energy, 1.5, 1e-12);
  EXPECT_EQ(spectrum(0.2).energy, 3);
  EXPECT_NEAR(spectrum(0.3).cosine[0], 0.5 * 2.5, 1e-12);
  EXPECT_EQ(spectrum(0.4).energy, 2);
  EXPECT_EQ(spectrum(0.4001).energy, 0);
}

TEST(BinnedSpectrum, HasBinsToHalfWayToTheirNeighbours) {
  const BinnedSpectrum spectrum = Bins({0.1, 0.2, 0.4}, {1, 3, 2});
  EXPECT_NEAR(spectrum.width(0), 0.1, 1e-15);
  EXPECT_NEAR(spectrum.width(1), 0.15, 1e-15);
  EXPECT_NEAR(spectrum.width(2), 0.2, 1e-15);
  EXPECT_NEAR(spectrum.significant_wave_height(), 4 * std::sqrt(0.1 + 0.45 + 0.4), 1e-14);
}

TEST(BinnedSpectrum, ComparesOnlyBinsWithEnergy) {
  const BinnedSpectrum spectrum = Bins({0.1, 0.2, 0.3, 0.4}, {1, 0, 2, 3});
  EXPECT_EQ(spectrum.ComparedFrequencies(0.15, 0.35), std::vector<double>{0.3});
}

// The integral of E over f, which is linear between centres, against that of S over k at samples of 5 %: the variance
// of a spectrum of straight lines errs by the kinks, at most (h / b)^2 / 4 where h is the step in f and b the distance
// of centres.
TEST(BinnedSpectrumByWavenumber, KeepsItsVariance) {
  const BinnedSpectrum spectrum = Bins({0.06, 0.09, 0.12, 0.15, 0.18}, {0, 2, 5, 3, 0});
  const double variance = 0.03 * (2 + 5 + 3);
  for (const double depth : {2.0, 12.0, 100.0, kDeep}) {
    const HarmonicSpectrum by_k = ByWavenumber(spectrum, depth, 0, SeaWavenumbers());
    const double step = 0.05 * 0.18 / 0.03;  // in deep water half of it, in shallow all
    EXPECT_NEAR(ElevationVariance(by_k) / variance, 1, step * step / 4) << depth;
    std::vector<double> fine;
    for (double k = 0.01; k < 1; k *= 1.0005) fine.push_back(k);
    EXPECT_NEAR(ElevationVariance(ByWavenumber(spectrum, depth, 0, fine)) / variance, 1, 1e-5) << depth;
  }
}

// Swell in one bin of 1 mHz, narrower than the step of 5 %: at any of its frequencies the variance is kept, and
// so is the second harmonic.
TEST(BinnedSpectrumByWavenumber, KeepsTheVarianceOfSwellBetweenItsWavenumbers) {
  for (double swell = 0.06; swell < 0.09; swell += 0.00037) {
    std::vector<double> f, energy;
    for (int i = -30; i <= 30; ++i) {
      f.push_back(swell + 0.001 * i);
      energy.push_back(i == 0 ? 1 : 0);
    }
    for (const double depth : {12.0, kDeep}) {
      const HarmonicSpectrum by_k = ByWavenumber(Bins(f, energy), depth, 0, SeaWavenumbers());
      EXPECT_NEAR(ElevationVariance(by_k) / 0.001, 1, 0.02) << swell << ' ' << depth;
      for (std::size_t i = 0; i < by_k.size(); ++i) {
        if (by_k.s[i] > 0) {
          EXPECT_NEAR(by_k.a[0][i], 0.5, 1e-12);
        }
      }
    }
  }
}

// x points to the east; waves along 60 degrees of the compass travel 30 degrees to its left.
TEST(BinnedSpectrumByWavenumber, TurnsFromTheCompassToTheFrame) {
  const BinnedSpectrum spectrum = Bins({0.1, 0.3}, {1, 1}, 60 * kDegree);
  const HarmonicSpectrum by_k = ByWavenumber(spectrum, kDeep, 90 * kDegree, {WavenumberOfFrequency(0.2, kDeep)});
  EXPECT_NEAR(by_k.a[0][0], 0.5 * std::cos(60 * kDegree), 1e-14);
  EXPECT_NEAR(by_k.b[0][0], 0.5 * std::sin(60 * kDegree), 1e-14);
}

TEST(BinnedSpectrumByWavenumber, DoesNotTellWavesFromThoseTheOppositeWay) {
  const std::vector<double> k = SeaWavenumbers();
  const HarmonicSpectrum from = ByWavenumber(Bins({0.1, 0.3}, {1, 1}, 1), 10, 0.4, k);
  const HarmonicSpectrum towards = ByWavenumber(Bins({0.1, 0.3}, {1, 1}, 1 + std::numbers::pi), 10, 0.4, k);
  for (std::size_t i = 0; i < k.size(); ++i) {
    EXPECT_NEAR(from.a[0][i], towards.a[0][i], 1e-14);
    EXPECT_NEAR(from.b[0][i], towards.b[0][i], 1e-14);
  }
}

TEST(BinnedSpectrum, LeadsAlongItsPeakAndEndsAlongItsShortWaves) {
  std::vector<DirectionalEnergy> bins;
  for (const auto& [energy, axis] : {std::pair(5.0, 0.2), {1.0, 0.9}, {2.0, 1.1}})
    bins.push_back(SymmetricEnergy(energy, {0.8}, axis));
  const BinnedSpectrum spectrum(std::make_shared<const std::vector<double>>(std::vector{0.1, 0.3, 0.4}), bins, 1, 0.4);
  EXPECT_NEAR(spectrum.leading_axis(), 0.2, 1e-14);
  EXPECT_GT(spectrum.ShortWaveAxis(0.4).value(), 0.9);
  EXPECT_LT(spectrum.ShortWaveAxis(0.4).value(), 1.1);
  EXPECT_NEAR(spectrum.ShortWaveAxis(0.2).value(), 0.2, 1e-14);  // no bin there
  EXPECT_EQ(spectrum.isotropic_share(), 0);
}

TEST(BinnedSpectrum, MayHaveNoDirectionInShortWaves) {
  const std::vector bins = {SymmetricEnergy(5, {0.8}, 0.2), DirectionalEnergy{.energy = 1},
                            DirectionalEnergy{.energy = 2}};
  const BinnedSpectrum spectrum(std::make_shared<const std::vector<double>>(std::vector{0.1, 0.2, 0.3}), bins, 1, 0.3);
  EXPECT_EQ(spectrum.ShortWaveAxis(0.3), std::nullopt);
  EXPECT_NEAR(spectrum.isotropic_share(), 3. / 8, 1e-14);
}

}  // namespace
}  // namespace albtpu
