#include "sea/spectra/described_sea.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sea/spectra/elfouhaily_spectrum.h"
#include "sea/spectra/equilibrium_wind.h"
#include "sea/spectra/spectrum_moments.h"
#include "sea/spectra/wind_sea.h"

namespace albtpu {
namespace {

constexpr double kDeep = std::numeric_limits<double>::infinity();

double WindSpeed(const SeaDescription& description, SeaAssumptions& assumed) {
  if (description.wind_speed_10m) return *description.wind_speed_10m;
  const auto friction_velocity = description.waves ? EquilibriumFrictionVelocity(*description.waves) : std::nullopt;
  assumed.wind_speed_from_waves = friction_velocity.has_value();
  assumed.wind_unknown = !friction_velocity;
  return WindSpeedOfFrictionVelocity(friction_velocity.value_or(0));
}

// The downwind direction; in a calm the direction of travel of the first waves.
double XAzimuth(const SeaDescription& description, double wind_speed, double tail_from, SeaAssumptions& assumed) {
  if (wind_speed > 0 && description.wind_from) return *description.wind_from + std::numbers::pi;
  if (!description.waves) return 0;
  if (wind_speed == 0) return description.waves->leading_axis();
  const std::optional<double> axis = description.waves->ShortWaveAxis(tail_from);
  assumed.wind_direction_from_waves = axis.has_value();
  assumed.wind_direction_unknown = !axis.has_value();
  return axis.value_or(0);
}

// Whether even the shortest described waves are faster than those that the wind raises: a fully developed sea's have a
// phase speed of the wind's over 0.84. The limit is our choice.
bool IsSwellAlone(const FrequencySpectrum& waves, double wind_speed) {
  constexpr double kOldestWindSea = 0.7;
  const std::optional<double> peak = waves.shortest_peak();
  return peak.has_value() && 2 * std::numbers::pi * *peak * wind_speed / kGravity < kOldestWindSea;
}

// Scales S(k) by a function of k.
template <typename Weight>
HarmonicSpectrum Weighted(HarmonicSpectrum spectrum, const Weight& weight) {
  for (std::size_t i = 0; i < spectrum.size(); ++i) spectrum.s[i] *= weight(spectrum.k[i]);
  return spectrum;
}

// The same waves in all directions.
void MakeIsotropic(HarmonicSpectrum& spectrum) {
  for (std::vector<double>& harmonic : spectrum.a) std::ranges::fill(harmonic, 0);
  for (std::vector<double>& harmonic : spectrum.b) std::ranges::fill(harmonic, 0);
}

}  // namespace

double FullTurn(double azimuth) {
  const double turned = std::fmod(azimuth, 2 * std::numbers::pi);
  return turned < 0 ? turned + 2 * std::numbers::pi : turned;
}

DescribedSea Describe(const SeaDescription& description) {
  const std::vector<double> k = SeaWavenumbers();
  DescribedSea sea;
  sea.water_depth = description.water_depth.value_or(kDeep);
  sea.wind_speed_10m = WindSpeed(description, sea.assumed);
  if (description.waves) {
    sea.assumed.tail_from_of_waves = !description.tail_from;
    sea.tail_from = description.tail_from.value_or(description.waves->trusted_up_to());
    sea.cutoff = WavenumberOfFrequency(sea.tail_from, sea.water_depth);
  }
  sea.x_azimuth = FullTurn(XAzimuth(description, sea.wind_speed_10m, sea.tail_from, sea.assumed));

  std::optional<ElfouhailySpectrum> wind;
  if (sea.wind_speed_10m > 0) wind.emplace(sea.wind_speed_10m, kFullyDeveloped);
  if (!description.waves) {
    sea.resolved = FlatSea(k, kSeaHarmonics);
    sea.spectrum = wind ? WindWaves(*wind, k) : sea.resolved;
    return sea;
  }

  const double last = description.waves->highest_frequency();
  const double end = std::isinf(last) ? last : WavenumberOfFrequency(last, sea.water_depth);
  const auto weight = [&](double at) { return at > end ? 1 : TailWeight(at, sea.cutoff); };
  sea.resolved = Weighted(ByWavenumber(*description.waves, sea.water_depth, sea.x_azimuth, k),
                          [&](double at) { return 1 - weight(at); });
  if (!wind || description.tail == TailRule::kNone) {
    sea.spectrum = sea.resolved;
    return sea;
  }
  const TailLevel level = LevelAtCutoff(*description.waves, *wind, sea.water_depth, sea.tail_from);
  sea.q = level.q;
  sea.assumed.level_held = level.held;
  sea.assumed.wind_sea_missing = level.held && level.q < 1 && IsSwellAlone(*description.waves, sea.wind_speed_10m);
  sea.assumed.level_unknown = level.compared == 0;
  HarmonicSpectrum tail = Weighted(WindWaves(*wind, k), [&](double at) {
    return weight(at) * std::pow(sea.q, LevelPower(description.tail, at, sea.cutoff));
  });
  if (sea.assumed.wind_direction_unknown) MakeIsotropic(tail);
  sea.spectrum = WeightedSum(sea.resolved, 1, tail, 1);
  return sea;
}

}  // namespace albtpu
