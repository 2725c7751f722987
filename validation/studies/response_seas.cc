#include "validation/studies/response_seas.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "sea/angle.h"
#include "sea/sampled_spectrum.h"
#include "sea/spectra/described_sea.h"
#include "sea/spectra/jonswap.h"

namespace albtpu {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

HarmonicSpectrum SamplesOf(const WindSea& waves) {
  return Sampled(*waves.MakeSpectrum(), SeaWavenumbers(), kSeaHarmonics);
}

// Waves of a height [m] and period [s] that travel `towards` [degree] to the left of their wind.
HarmonicSpectrum Waves(double hs, double tp, double towards, double wind, double depth) {
  const JonswapWaves waves{.significant_wave_height = hs,
                           .peak_period = tp,
                           .travels_towards = RadiansOfDegrees(-towards)};  // of the compass, clockwise
  return Describe({.waves = std::make_shared<JonswapSpectrum>(std::vector{waves}, depth),
                   .wind_speed_10m = wind,
                   .wind_from = std::numbers::pi,
                   .water_depth = depth})
      .spectrum;
}

HarmonicSpectrum Jonswap() { return Waves(0.6, 3.2, 20, 6, kInf); }
HarmonicSpectrum Tma() { return Waves(0.5, 4, 40, 7, 5); }

// A wind sea of Elfouhaily's with a swell of 0.57 m and 25 m that travels `degrees` to the left of the wind.
HarmonicSpectrum CrossingSwell(double wind, double degrees) {
  constexpr double kPeak = 0.25, kWidth = 0.25, kVariance = 0.02, kSpreading = 12;
  HarmonicSpectrum swell = FlatSea(SeaWavenumbers(), kSeaHarmonics);
  for (std::size_t i = 0; i < swell.size(); ++i) {
    const double x = std::log(swell.k[i] / kPeak) / kWidth;
    swell.s[i] = kVariance * std::exp(-x * x / 2) / (swell.k[i] * kWidth * std::sqrt(2 * std::numbers::pi));
  }
  double mean = 1;  // of cos(n psi) under cos^2s(psi / 2)
  for (int n = 1; n <= 2 * static_cast<int>(kSeaHarmonics); ++n) {
    mean *= (kSpreading - n + 1) / (kSpreading + n);
    if (n % 2 == 0) std::fill(swell.a[n / 2 - 1].begin(), swell.a[n / 2 - 1].end(), mean);
  }
  return WeightedSum(SamplesOf({.wind_speed_10m = wind, .model = &kElfouhailyModel}), 1,
                     Rotated(std::move(swell), RadiansOfDegrees(degrees)), 1);
}

HarmonicSpectrum Isotropic() {
  const HarmonicSpectrum sea = SamplesOf({8, kInf, &kElfouhailyModel});
  HarmonicSpectrum even = FlatSea(sea.k, kSeaHarmonics);
  even.s = sea.s;
  return even;
}

// Without the waves much shorter than 2 pi / `highest` [rad/m].
HarmonicSpectrum Without(HarmonicSpectrum sea, double highest) {
  for (std::size_t i = 0; i < sea.size(); ++i) sea.s[i] *= std::exp(-std::pow(sea.k[i] / highest, 4));
  return sea;
}

HarmonicSpectrum WithoutCapillaries() { return Without(SamplesOf({9, kInf, &kElfouhailyModel}), 200); }

WindSea YoungSea() { return {.wind_speed_10m = 10, .fetch = 2e3, .model = &kElfouhailyModel}; }
WindSea NarrowSea() { return {.wind_speed_10m = 6, .spreading = 15}; }

}  // namespace

ResponseSea ResponseSeaOf(std::string name, const WindSea& waves) {
  return {std::move(name), waves, SamplesOf(waves)};
}

ResponseSea ResponseSeaOf(std::string name, const HarmonicSpectrum& spectrum) {
  const KnownWaves waves{std::make_shared<SampledSpectrum>(
      spectrum, SpectrumText{.name = name, .reference = "none", .departures = "none"})};
  return {std::move(name), waves, spectrum};
}

std::vector<ResponseSea> ResponseSeas() {
  return {ResponseSeaOf("Apel, 9 m/s", WindSea{9, kInf, &kApelModel}),
          ResponseSeaOf("Apel, 13 m/s, 20 km", WindSea{13, 2e4, &kApelModel}),
          ResponseSeaOf("Elfouhaily, 8 m/s", WindSea{8, kInf, &kElfouhailyModel}),
          ResponseSeaOf("Elfouhaily, 10 m/s, 2 km", YoungSea()),
          ResponseSeaOf("JONSWAP and tail", Jonswap()),
          ResponseSeaOf("swell at 30 degrees", CrossingSwell(5, 30)),
          ResponseSeaOf("swell at 60 degrees", CrossingSwell(7, 60)),
          ResponseSeaOf("swell at 120 degrees", CrossingSwell(9, 120)),
          ResponseSeaOf("TMA in 5 m", Tma()),
          ResponseSeaOf("isotropic", Isotropic()),
          ResponseSeaOf("narrow", NarrowSea()),
          ResponseSeaOf("without capillaries", WithoutCapillaries())};
}

std::vector<ResponseSea> ResolvedSeas() {
  const auto resolved = [](std::string name, const HarmonicSpectrum& spectrum) {
    return ResponseSeaOf(std::move(name), Without(spectrum, 30));
  };
  return {resolved("Apel, 15 m/s", SamplesOf({15, kInf, &kApelModel})),
          resolved("Apel, 15 m/s, 1.5 km", SamplesOf({15, 1.5e3, &kApelModel})),
          resolved("Elfouhaily, 10 m/s, 2 km", SamplesOf(YoungSea())),
          resolved("JONSWAP and tail", Jonswap()),
          resolved("swell at 60 degrees", CrossingSwell(7, 60)),
          resolved("narrow", SamplesOf(NarrowSea()))};
}

}  // namespace albtpu
