#include "tests/validation/physics/response_seas.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <numbers>

#include "sea/angle.h"
#include "sea/files/sea_file.h"
#include "sea/spectra/described_sea.h"
#include "sea/spectra/jonswap.h"
#include "tests/validation/physics/sampled_waves.h"

namespace albtpu {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
const std::filesystem::path kBuoy = std::filesystem::path(SEA_SAMPLES) / "41010.data_spec";

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
template <int wind, int degrees>
HarmonicSpectrum CrossingSwell() {
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
  return WeightedSum(SamplesOf({wind, kInf, &kElfouhailyModel}), 1,
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

HarmonicSpectrum Measured() { return Describe(ReadSeaFile(kBuoy)->records.front()).spectrum; }

HarmonicSpectrum Young() { return SamplesOf({10, 2e3, &kElfouhailyModel}); }
HarmonicSpectrum YoungStorm() { return SamplesOf({15, 1.5e3, &kApelModel}); }
HarmonicSpectrum Storm() { return SamplesOf({15, kInf, &kApelModel}); }
HarmonicSpectrum Narrow() { return SamplesOf({.wind_speed_10m = 6, .spreading = 15}); }

template <HarmonicSpectrum (*make)()>
HarmonicSpectrum Resolved() {
  return Without(make(), 30);
}

// Wind and fetch say nothing in such a sea.
template <HarmonicSpectrum (*make)()>
NamedSea Of(const char* name) {
  return {name, {.wind_speed_10m = 1, .model = &kSampled<make>}};
}

}  // namespace

bool HasBuoy() { return std::filesystem::exists(kBuoy); }

std::vector<NamedSea> ResponseSeas(bool buoy) {
  std::vector<NamedSea> seas = {{"Apel, 9 m/s", {9, kInf, &kApelModel}},
                                {"Apel, 13 m/s, 20 km", {13, 2e4, &kApelModel}},
                                {"Elfouhaily, 8 m/s", {8, kInf, &kElfouhailyModel}},
                                {"Elfouhaily, 10 m/s, 2 km", {10, 2e3, &kElfouhailyModel}},
                                Of<Jonswap>("JONSWAP and tail"),
                                Of<CrossingSwell<5, 30>>("swell at 30 degrees"),
                                Of<CrossingSwell<7, 60>>("swell at 60 degrees"),
                                Of<CrossingSwell<9, 120>>("swell at 120 degrees"),
                                Of<Tma>("TMA in 5 m"),
                                Of<Isotropic>("isotropic"),
                                {"narrow", {.wind_speed_10m = 6, .spreading = 15}},
                                Of<WithoutCapillaries>("without capillaries")};
  if (buoy) seas.push_back(Of<Measured>("NDBC 41010"));
  return seas;
}

std::vector<NamedSea> ResolvedSeas() {
  return {Of<Resolved<Storm>>("Apel, 15 m/s"),
          Of<Resolved<YoungStorm>>("Apel, 15 m/s, 1.5 km"),
          Of<Resolved<Young>>("Elfouhaily, 10 m/s, 2 km"),
          Of<Resolved<Jonswap>>("JONSWAP and tail"),
          Of<Resolved<CrossingSwell<7, 60>>>("swell at 60 degrees"),
          Of<Resolved<Narrow>>("narrow")};
}

HarmonicSpectrum SpectrumOf(const NamedSea& sea) { return SamplesOf(sea.waves); }

}  // namespace albtpu
