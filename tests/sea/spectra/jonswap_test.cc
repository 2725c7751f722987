#include "sea/spectra/jonswap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sea/spectra/spectrum_moments.h"
#include "sea/spectra/wave_spreading.h"
#include "tests/sea/spectra/deep_water.h"

namespace albtpu {
namespace {

JonswapWaves Waves(double hs, double tp, double gamma) {
  return {.significant_wave_height = hs, .peak_period = tp, .gamma = gamma};
}

// Without enhancement the integral has a closed form: E = 5/16 Hs^2 fp^4 f^-5 exp(-1.25 (fp / f)^4).
TEST(Jonswap, IsPiersonAndMoskowitzWithoutEnhancement) {
  const JonswapSpectrum spectrum({Waves(1.7, 5, 1)});
  for (const double f : {0.1, 0.2, 0.4, 2.0}) {
    const double expected =
        5.0 / 16 * 1.7 * 1.7 * std::pow(0.2, 4) * std::pow(f, -5) * std::exp(-1.25 * std::pow(0.2 / f, 4));
    EXPECT_NEAR(spectrum(f).energy / expected, 1, 1e-7) << f;
  }
}

TEST(Jonswap, IsEnhancedGammaTimesAtThePeak) {
  const JonswapSpectrum plain({Waves(1, 5, 1)}), enhanced({Waves(1, 5, 3.3)});
  const double scale = enhanced(5).energy / plain(5).energy;  // far above the peak only the scales differ
  EXPECT_NEAR(enhanced(0.2).energy / plain(0.2).energy / scale, 3.3, 1e-12);
  // One sigma below and above the peak: 0.07 and 0.09 of its frequency.
  const double at_sigma = std::pow(3.3, std::exp(-0.5));
  for (const double f : {0.2 * 0.93, 0.2 * 1.09})
    EXPECT_NEAR(enhanced(f).energy / plain(f).energy / scale, at_sigma, 1e-12);
}

double Variance(const JonswapSpectrum& spectrum, double fp) {
  constexpr double kStep = 1e-4;
  double sum = 0;
  for (double x = std::log(0.3 * fp); x < std::log(1000.0 * fp); x += kStep)
    sum += kStep * std::exp(x) * spectrum(std::exp(x)).energy;
  return sum;
}

TEST(Jonswap, HasItsSignificantWaveHeightAtEachDepth) {
  for (const double depth : {0.5, 3.0, 12.0, kDeep}) {
    for (const double gamma : {1.0, 3.3, 10.0}) {
      const JonswapSpectrum spectrum({Waves(0.8, 8, gamma)}, depth);
      EXPECT_NEAR(4 * std::sqrt(Variance(spectrum, 0.125)) / 0.8, 1, 1e-6) << depth << " m, gamma " << gamma;
    }
  }
}

TEST(Tma, BecomesJonswapInDeepWater) {
  const JonswapSpectrum deep({Waves(1, 6, 3.3)}), tma({Waves(1, 6, 3.3)}, 500);
  for (const double f : {0.1, 1.0 / 6, 0.3, 1.0}) EXPECT_NEAR(tma(f).energy / deep(f).energy, 1, 1e-9);
}

// Bouws et al. (1985): in the shallow limit the factor is (k h)^2 / 2 = omega^2 h / (2 g), so that E falls as f^-3.
TEST(Tma, FallsWithTheThirdPowerOfFrequencyInShallowWater) {
  const JonswapSpectrum tma({Waves(0.05, 60, 1)}, 0.5);
  const double ratio = tma(0.1).energy / tma(0.2).energy;
  EXPECT_NEAR(ratio, 8 * std::exp(-1.25 * (std::pow(1 / 6.0, 4) - std::pow(1 / 12.0, 4))), 0.03);
  const JonswapSpectrum deep({Waves(0.05, 60, 1)});
  EXPECT_NEAR(deep(0.1).energy / deep(0.2).energy, 32, 0.1);
}

// Linear in k between samples of 5 %, sums of trapezoids are too large by 2.5e-3 S'' k^2 / 12: some 4e-4 for k^2 S''
// of twice S, which holds on average. The height has half of it.
TEST(JonswapByWavenumber, KeepsItsHeight) {
  for (const double depth : {3.0, 12.0, kDeep}) {
    for (const double tp : {2.7, 8.0, 16.0}) {
      const JonswapSpectrum spectrum({Waves(1, tp, 3.3)}, depth);
      EXPECT_NEAR(SignificantWaveHeight(ByWavenumber(spectrum, depth, 0, SeaWavenumbers())), 1, 5e-4)
          << tp << " s in " << depth << " m";
    }
  }
}

TEST(Jonswap, AddsVariancesOfItsComponents) {
  JonswapWaves swell = Waves(4, 10, 7), sea = Waves(3, 4, 3.3);
  const JonswapSpectrum both({swell, sea}), first({swell}), second({sea});
  EXPECT_EQ(both.significant_wave_height(), 5);
  for (const double f : {0.1, 0.25, 0.5}) EXPECT_NEAR(both(f).energy, first(f).energy + second(f).energy, 1e-14);
}

TEST(Jonswap, SpreadsItsWavesAboutTheirDirection) {
  const double direction = 0.7;
  JonswapWaves waves = Waves(1, 5, 3.3);
  waves.travels_towards = direction;
  const DirectionalEnergy at_peak = JonswapSpectrum({waves})(0.2);
  const double a_1 = 10.0 / 11 * 9 / 12;  // s = 10
  EXPECT_NEAR(at_peak.cosine[0] / at_peak.energy, a_1 * std::cos(2 * direction), 1e-14);
  EXPECT_NEAR(at_peak.sine[0] / at_peak.energy, a_1 * std::sin(2 * direction), 1e-14);
  EXPECT_NEAR(at_peak.PrincipalAxis(), direction, 1e-14);
  waves.spread = 0;
  EXPECT_NEAR(std::hypot(JonswapSpectrum({waves})(0.3).cosine[0], JonswapSpectrum({waves})(0.3).sine[0]) /
                  JonswapSpectrum({waves})(0.3).energy,
              1, 1e-14);
}

TEST(Jonswap, IsTrustedUpToWhereItsShortestWavesAreInEquilibrium) {
  EXPECT_NEAR(JonswapSpectrum({Waves(1, 9.5, 7), Waves(0.4, 2.5, 3.3)}).trusted_up_to(), 1, 1e-14);
  EXPECT_EQ(JonswapSpectrum({Waves(1, 9.5, 7)}).trusted_up_to(), 0.4);
}

}  // namespace
}  // namespace albtpu
