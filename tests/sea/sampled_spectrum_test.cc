#include "sea/sampled_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "sea/response/closed_form.h"
#include "sea/sea_state.h"
#include "sea/spectra/spectrum_moments.h"
#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

SeaState SeaOf(const HarmonicSpectrum& spectrum) {
  return SeaState({.waves = KnownWaves{std::make_shared<SampledSpectrum>(spectrum, SpectrumText{"n", "r", "d"})}});
}

// Covariance of the slopes by trapezoids in k over the samples, from the second harmonics alone.
Eigen::Matrix2d FromSamples(const HarmonicSpectrum& sea) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < sea.size(); ++i) {
    const double before = i > 0 ? sea.k[i - 1] : sea.k[i], after = i + 1 < sea.size() ? sea.k[i + 1] : sea.k[i];
    const double slope = sea.s[i] * sea.k[i] * sea.k[i] * (after - before) / 2;
    sum += 0.5 * slope * (Eigen::Matrix2d() << 1 + sea.a[0][i], sea.b[0][i], sea.b[0][i], 1 - sea.a[0][i]).finished();
  }
  return sum;
}

TEST(SampledSpectrum, IsTheSamplesAtTheSamples) {
  const HarmonicSpectrum sea = CrossingSea();
  const SampledSpectrum spectrum(sea, {"a name", "a reference", "departures"});
  for (std::size_t i = 0; i < sea.size(); i += 7) EXPECT_NEAR(spectrum(sea.k[i]), sea.s[i], 1e-9 * sea.s[i]);
  EXPECT_EQ(spectrum(0.5 * sea.k.front()), 0);
  EXPECT_EQ(spectrum(2 * sea.k.back()), 0);
  EXPECT_EQ(spectrum.name(), "a name");
  EXPECT_EQ(spectrum.reference(), "a reference");
  EXPECT_EQ(spectrum.departures(), "departures");
}

// k^3 S that is constant stays so between the samples.
TEST(SampledSpectrum, KeepsASaturatedSpectrumBetweenSamples) {
  HarmonicSpectrum sea = FlatSea(SeaWavenumbers(), 1);
  for (std::size_t i = 0; i < sea.size(); ++i) sea.s[i] = 0.01 * std::pow(sea.k[i], -3);
  const SampledSpectrum spectrum(sea, {});
  for (double k = 0.01; k < 3000; k *= 1.37) EXPECT_NEAR(spectrum(k) * k * k * k, 0.01, 1e-12);
}

// The samples are 5 % apart: trapezoids in k and in ln k differ by 0.05^2 / 12 of the second derivatives, a few times
// the integrand.
TEST(SampledSpectrum, HasTheSlopesAndHeightsOfItsSamples) {
  for (const HarmonicSpectrum& sea : {WindSeaOf(6), WindSeaOf(11, kApelModel), CrossingSea()}) {
    const SeaState state = SeaOf(sea);
    const Eigen::Matrix2d slopes = SlopeCovariance(state), expected = FromSamples(sea);
    EXPECT_LT((slopes - expected).cwiseAbs().maxCoeff(), 2e-3 * expected.trace());
    EXPECT_NEAR(ElevationVariance(state) / ElevationVariance(sea), 1, 3e-3);
  }
}

TEST(SampledSpectrum, OfAWindSeaRefractsAsItsModel) {
  const BeamOptions beam{.incidence = 0.3, .azimuth = 0.7, .footprint = 0.6};
  for (const SpectrumModel* model : kSpectrumModels) {
    const SmallSlopeUncertainty sampled = ClosedForm(SeaOf(WindSeaOf(8, *model)), beam, kRefractiveIndex);
    const SmallSlopeUncertainty exact =
        ClosedForm(SeaState({.waves = WindSea{.wind_speed_10m = 8, .model = model}}), beam, kRefractiveIndex);
    EXPECT_NEAR(sampled.refraction_along_wind / exact.refraction_along_wind, 1, 1e-3);
    EXPECT_NEAR(sampled.refraction_cross_wind / exact.refraction_cross_wind, 1, 1e-3);
    EXPECT_NEAR(sampled.tvu_per_depth / exact.tvu_per_depth, 1, 1e-3);
  }
}

TEST(SampledSpectrum, TurnsWithItsSea) {
  const double angle = 0.9;
  const SeaState sea = SeaOf(CrossingSea()), turned = SeaOf(Rotated(CrossingSea(), angle));
  for (const double psi : {0.0, 0.5, 2.2})
    for (const double k : {0.4, 3.0, 200.0}) EXPECT_NEAR(turned.Psi(k, psi + angle) / sea.Psi(k, psi), 1, 1e-6);
}

TEST(SampledSpectrum, MayHaveNoWaves) {
  const SeaState calm = SeaOf(FlatSea(SeaWavenumbers(), 2));
  EXPECT_EQ(ElevationVariance(calm), 0);
  EXPECT_EQ(SlopeCovariance(calm).trace(), 0);
}

// Swell alone, all of which is longer than what is corrected for.
TEST(SeaState, HasNoWavesIfAllAreCorrectedFor) {
  const auto swell = std::make_shared<SampledSpectrum>(Swell(0.03, 0.2, 0, 0.5, 0.1), SpectrumText{});
  const SeaState sea({.waves = KnownWaves{swell}, .corrected_above = 0.01});
  EXPECT_EQ(SlopeCovariance(sea).trace(), 0);
}

// The mean over the energy of f(psi), by a sum over the full turn, exact for smooth functions.
template <typename Function>
double Mean(const PositiveSpreading& spreading, const Function& f) {
  constexpr int kSteps = 2000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double psi = 2 * std::numbers::pi * (i + 0.3) / kSteps;
    sum += spreading(psi) * f(psi) * 2 * std::numbers::pi / kSteps;
  }
  return sum;
}

double Least(const PositiveSpreading& spreading) {
  double least = 1;
  for (double psi = 0; psi < std::numbers::pi; psi += 0.001) least = std::min(least, spreading(psi));
  return least;
}

TEST(PositiveSpreading, IsTheSeriesWhereThatIsPositive) {
  const PositiveSpreading spreading({0.3, 0.05}, {-0.2, 0.1});
  for (const double psi : {0.0, 0.4, 2.0, -1.0, 5.0}) {
    const double series = 1 + 2 * (0.3 * std::cos(2 * psi) - 0.2 * std::sin(2 * psi) + 0.05 * std::cos(4 * psi) +
                                   0.1 * std::sin(4 * psi));
    EXPECT_NEAR(spreading(psi), series / (2 * std::numbers::pi), 1e-15);
  }
}

TEST(PositiveSpreading, LooksAlikeAfterHalfATurn) {
  for (const double a : {0.2, 0.8}) {
    const PositiveSpreading spreading({a}, {0.1});
    for (const double psi : {0.0, 0.7, 2.5}) EXPECT_NEAR(spreading(psi), spreading(psi + std::numbers::pi), 1e-12);
  }
}

// Whether or not harmonics that are not known follow as zeros. The ridge moves a harmonic by 1e-7 times a coefficient
// of some tens.
TEST(PositiveSpreading, HasTheHarmonicsThatItIsGiven) {
  for (const double axis : {0.0, 0.6, 2.0}) {
    for (const double r2 : {0.55, 0.8, 0.95}) {
      const PositiveSpreading spreading({r2 * std::cos(2 * axis), 0, 0}, {r2 * std::sin(2 * axis), 0, 0});
      EXPECT_GE(Least(spreading), 0);
      EXPECT_NEAR(Mean(spreading, [](double) { return 1; }), 1, 1e-9);
      EXPECT_NEAR(Mean(spreading, [&](double psi) { return std::cos(2 * (psi - axis)); }), r2, 1e-5);
      EXPECT_NEAR(Mean(spreading, [&](double psi) { return std::sin(2 * (psi - axis)); }), 0, 1e-5);
    }
  }
}

// cos^2s(psi / 2) with s = 25 on a frozen surface, of which the harmonics 2 to 12 are known. Their series is negative.
TEST(PositiveSpreading, HasAllHarmonicsOfANarrowSwell) {
  constexpr double kS = 25;
  std::vector<double> a, b(6);
  double product = 1;
  for (int n = 1; n <= 12; ++n) {
    product *= (kS - n + 1) / (kS + n);
    if (n % 2 == 0) a.push_back(product);
  }
  const PositiveSpreading spreading(a, b);
  EXPECT_GE(Least(spreading), 0);
  for (int n = 1; n <= 6; ++n)
    EXPECT_NEAR(Mean(spreading, [&](double psi) { return std::cos(2 * n * psi); }), a[n - 1], 1e-5) << n;
  // The harmonics that are not given come out nearly right as well.
  for (int n = 13; n <= 14; ++n) product *= (kS - n + 1) / (kS + n);
  EXPECT_NEAR(Mean(spreading, [&](double psi) { return std::cos(14 * psi); }), product, 0.02);
}

TEST(PositiveSpreading, ExistsForHarmonicsThatNoDensityHas) {
  for (const auto& a : std::vector<std::vector<double>>{{1}, {1.2}, {0.95, 0.1}, {0, -1.5, 0.3}}) {
    const PositiveSpreading spreading(a, std::vector<double>(a.size()));
    EXPECT_GE(Least(spreading), 0);
    EXPECT_NEAR(Mean(spreading, [](double) { return 1; }), 1, 1e-3);
  }
}

}  // namespace
}  // namespace albtpu
