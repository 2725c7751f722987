#include "sea/sampled_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

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

}  // namespace
}  // namespace albtpu
