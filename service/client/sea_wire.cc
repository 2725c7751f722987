#include "service/client/sea_wire.h"

#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

namespace albtpu::client {
namespace {

namespace v1 = albtpu::v1;

v1::TailRule ToWire(TailRule rule) {
  switch (rule) {
    case TailRule::kWind:
      return v1::TAIL_RULE_WIND;
    case TailRule::kRelax:
      return v1::TAIL_RULE_RELAX;
    case TailRule::kLevel:
      return v1::TAIL_RULE_LEVEL;
    case TailRule::kNone:
      return v1::TAIL_RULE_NONE;
  }
  return v1::TAIL_RULE_UNSPECIFIED;
}

// The number of harmonics up to the last one that is not +0 in all bins.
std::size_t HarmonicsOf(const BinnedSpectrum& bins) {
  const auto is_set = [](double value) { return value != 0 || std::signbit(value); };
  std::size_t harmonics = 0;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const DirectionalEnergy bin = bins.bin(i);
    for (std::size_t n = harmonics; n < kSeaHarmonics; ++n)
      if (is_set(bin.cosine[n]) || is_set(bin.sine[n])) harmonics = n + 1;
  }
  return harmonics;
}

// Sets the waves of a sea.
struct WavesWriter {
  v1::SeaState& state;
  double record_length;

  void operator()(std::monostate) const {}

  void operator()(const WaveComponents& components) const {
    v1::WaveComponents& message = *state.mutable_components();
    for (const JonswapWaves& waves : *components) {
      v1::WaveComponent& each = *message.add_components();
      each.set_significant_wave_height(waves.significant_wave_height);
      each.set_peak_period(waves.peak_period);
      each.set_gamma(waves.gamma);
      each.set_travels_towards(waves.travels_towards);
      if (waves.spread) each.set_spread(*waves.spread);
    }
  }

  void operator()(const BinnedWaves& bins) const {
    v1::FrequencySpectrum& message = *state.mutable_frequency_spectrum();
    for (std::size_t i = 0; i < bins->size(); ++i) {
      message.add_frequencies(bins->centre(i));
      message.add_densities(bins->bin(i).energy);
    }
    for (std::size_t n = 0; n < HarmonicsOf(*bins); ++n) {
      for (std::size_t i = 0; i < bins->size(); ++i) {
        message.add_cosines(bins->bin(i).cosine[n]);
        message.add_sines(bins->bin(i).sine[n]);
      }
    }
    message.set_trusted_up_to(bins->trusted_up_to());
    if (std::isfinite(record_length)) message.set_record_length(record_length);
  }

  void operator()(const WholeSea& sea) const {
    v1::WavenumberSpectrum& message = *state.mutable_wavenumber_spectrum();
    message.mutable_wavenumbers()->Add(sea->k.begin(), sea->k.end());
    message.mutable_densities()->Add(sea->s.begin(), sea->s.end());
    for (const std::vector<double>& a : sea->a) message.mutable_cosines()->Add(a.begin(), a.end());
    for (const std::vector<double>& b : sea->b) message.mutable_sines()->Add(b.begin(), b.end());
  }
};

}  // namespace

v1::SeaState ToWire(const KnownSea& sea) {
  v1::SeaState state;
  std::visit(WavesWriter{state, sea.record_length}, sea.waves);
  if (sea.wind_speed_10m) state.set_wind_speed(*sea.wind_speed_10m);
  if (sea.wind_from) state.set_wind_from(*sea.wind_from);
  if (sea.water_depth && std::isfinite(*sea.water_depth)) state.set_water_depth(*sea.water_depth);
  state.set_tail_rule(ToWire(sea.tail));
  if (sea.tail_from) state.set_tail_from(*sea.tail_from);
  return state;
}

SeaSummary FromWire(const v1::SeaSummary& sea) {
  return {.x_azimuth = sea.x_azimuth(),
          .significant_wave_height = sea.significant_wave_height(),
          .wind_speed_10m = sea.wind_speed(),
          .water_depth = sea.water_depth(),
          .tail_from = sea.tail_from(),
          .share_measured = sea.share_measured(),
          .assumptions = {sea.assumptions().begin(), sea.assumptions().end()}};
}

}  // namespace albtpu::client
