#include "sea/spectra/harmonic_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sea/spectra/apel_spectrum.h"
#include "sea/spectra/elfouhaily_spectrum.h"
#include "sea/spectra/wind_sea.h"

namespace albtpu {
namespace {

TEST(SeaWavenumbers, IncreaseByAtMost5PerCent) {
  const std::vector<double> k = SeaWavenumbers();
  EXPECT_EQ(k.front(), 0.004);
  EXPECT_EQ(k.back(), 3500);
  for (std::size_t i = 1; i < k.size(); ++i) {
    EXPECT_GT(k[i] / k[i - 1], 1.045);
    EXPECT_LE(k[i] / k[i - 1], 1.05);
  }
}

// The harmonics of cos^(2s) of half the angle are products of (s - j + 1) / (s + j) over j up to 2 n: for s = 2,
// a_1 = 2/3 * 1/4 = 1/6 and nothing above.
TEST(SampledSpectrum, HasTheHarmonicsOfACosineSpreading) {
  const HarmonicSpectrum sampled = Sampled(ApelSpectrum(8, kFullyDeveloped), SeaWavenumbers(), 3);
  ASSERT_EQ(sampled.harmonics(), 3u);
  for (std::size_t i = 0; i < sampled.size(); ++i) {
    EXPECT_NEAR(sampled.a[0][i], 1.0 / 6, 1e-14);
    EXPECT_NEAR(sampled.a[1][i], 0, 1e-14);
    EXPECT_NEAR(sampled.a[2][i], 0, 1e-14);
    EXPECT_NEAR(sampled.b[0][i], 0, 1e-14);
  }
}

TEST(SampledSpectrum, HasTheHarmonicsOfASpreadingThatVariesWithWavenumber) {
  const ElfouhailySpectrum spectrum(8, kFullyDeveloped);
  const HarmonicSpectrum sampled = Sampled(spectrum, SeaWavenumbers(), 2);
  for (std::size_t i = 0; i < sampled.size(); ++i) {
    EXPECT_EQ(sampled.s[i], spectrum(sampled.k[i]));
    EXPECT_NEAR(sampled.a[0][i], spectrum.Delta(sampled.k[i]) / 2, 1e-14);
    EXPECT_NEAR(sampled.a[1][i], 0, 1e-14);
  }
}

// The harmonics of |cos(psi / 2)|, s = 1/2, decay slowly: a_1 = (1/2 / 3/2) (-1/2 / 5/2) = -1/15.
TEST(SampledSpectrum, HasTheHarmonicsOfASpreadingWithoutEnd) {
  const ApelSpectrum spectrum(8, kFullyDeveloped, Cosine2sSpreading(0.5));
  EXPECT_NEAR(Sampled(spectrum, {1.0}, 1).a[0][0], -1.0 / 15, 1e-6);
}

HarmonicSpectrum Constant(double s, double a, double b) {
  HarmonicSpectrum spectrum = FlatSea({1, 2, 4}, 1);
  spectrum.s.assign(3, s);
  spectrum.a[0].assign(3, a);
  spectrum.b[0].assign(3, b);
  return spectrum;
}

TEST(HarmonicSpectrum, AddsEnergyAndWeighsHarmonicsByIt) {
  const HarmonicSpectrum sum = WeightedSum(Constant(2, 0.5, 0), 1, Constant(6, 0.1, 0.4), 1);
  EXPECT_EQ(sum.s[1], 8);
  EXPECT_NEAR(sum.a[0][1], (2 * 0.5 + 6 * 0.1) / 8, 1e-15);
  EXPECT_NEAR(sum.b[0][1], 6 * 0.4 / 8, 1e-15);
  const HarmonicSpectrum half = WeightedSum(Constant(2, 0.5, 0), 0.5, FlatSea({1, 2, 4}, 3), 0.5);
  EXPECT_EQ(half.s[0], 1);
  EXPECT_EQ(half.a[0][0], 0.5);
  EXPECT_EQ(half.a[2][0], 0);
}

// Waves along psi have harmonics cos 2 psi and sin 2 psi.
TEST(HarmonicSpectrum, TurnsByAnAngle) {
  const double psi = 0.3, angle = 0.5;
  const HarmonicSpectrum turned = Rotated(Constant(1, std::cos(2 * psi), std::sin(2 * psi)), angle);
  EXPECT_NEAR(turned.a[0][2], std::cos(2 * (psi + angle)), 1e-15);
  EXPECT_NEAR(turned.b[0][2], std::sin(2 * (psi + angle)), 1e-15);
  EXPECT_EQ(turned.s[2], 1);
}

TEST(HarmonicSpectrum, IsTheSameTurnedByHalfATurn) {
  const HarmonicSpectrum spectrum = Sampled(ElfouhailySpectrum(8, kFullyDeveloped), SeaWavenumbers(), 3);
  const HarmonicSpectrum turned = Rotated(spectrum, std::numbers::pi);
  for (std::size_t i = 0; i < spectrum.size(); ++i) EXPECT_NEAR(turned.a[0][i], spectrum.a[0][i], 1e-14);
}

TEST(HarmonicSpectrum, IsLinearBetweenSamplesAndZeroBeyond) {
  HarmonicSpectrum spectrum = Constant(2, 0.5, 0);
  spectrum.s[2] = 6;
  spectrum.a[0][2] = 0.1;
  const HarmonicSpectrum resampled = Resampled(spectrum, {0.5, 1, 3, 4, 5});
  EXPECT_EQ(resampled.s, (std::vector<double>{0, 2, 4, 6, 0}));
  EXPECT_NEAR(resampled.a[0][2], (0.5 * 2 * 0.5 + 0.5 * 6 * 0.1) / 4, 1e-15);  // S a is linear, not a
  EXPECT_EQ(resampled.a[0][4], 0);
}

}  // namespace
}  // namespace albtpu
