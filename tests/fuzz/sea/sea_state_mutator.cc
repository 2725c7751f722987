// Mutates seas field by field, so that most of them stay valid messages; some byte by byte.

#include "albtpu/v1/sea.pb.h"
#include "tests/fuzz/mutation.h"

namespace {

using namespace albtpu;
using Numbers = google::protobuf::RepeatedField<double>;

double AnyNumber(std::mt19937& random) {
  if (random() % 2 == 0) return fuzz::NotableNumber<double>(random);
  return static_cast<double>(random()) / 4294967296.0 * (random() % 2 == 0 ? 1 : 20);
}

void Mutate(std::mt19937& random, Numbers& numbers) {
  switch (random() % 4) {
    case 0:
      numbers.Add(AnyNumber(random));
      return;
    case 1:
      if (!numbers.empty()) numbers.RemoveLast();
      return;
    default:
      if (!numbers.empty())
        numbers[static_cast<int>(random() % static_cast<unsigned>(numbers.size()))] = AnyNumber(random);
  }
}

void Mutate(std::mt19937& random, v1::WaveComponent& waves) {
  const double number = AnyNumber(random);
  switch (random() % 5) {
    case 0:
      return waves.set_significant_wave_height(number);
    case 1:
      return waves.set_peak_period(number);
    case 2:
      return random() % 3 == 0 ? waves.clear_gamma() : waves.set_gamma(number);
    case 3:
      return waves.set_travels_towards(number);
    default:
      return random() % 3 == 0 ? waves.clear_spread() : waves.set_spread(number);
  }
}

// A spectrum over frequency or over wavenumber.
template <typename Spectrum>
void MutateLists(std::mt19937& random, Spectrum& spectrum, Numbers& axis) {
  switch (random() % 5) {
    case 0:
      return Mutate(random, axis);
    case 1:
      return Mutate(random, *spectrum.mutable_densities());
    case 2:
      return Mutate(random, *spectrum.mutable_cosines());
    case 3:
      return Mutate(random, *spectrum.mutable_sines());
    default:  // Another harmonic.
      spectrum.mutable_cosines()->Resize(spectrum.cosines_size() + axis.size(), 0);
      spectrum.mutable_sines()->Resize(spectrum.cosines_size(), 0);
  }
}

void MutateWaves(std::mt19937& random, v1::SeaState& state) {
  switch (state.waves_case()) {
    case v1::SeaState::kComponents: {
      v1::WaveComponents& waves = *state.mutable_components();
      if (waves.components_size() == 0 || random() % 8 == 0) waves.add_components()->set_peak_period(5);
      return Mutate(random, *waves.mutable_components(
                                static_cast<int>(random() % static_cast<unsigned>(waves.components_size()))));
    }
    case v1::SeaState::kFrequencySpectrum: {
      v1::FrequencySpectrum& spectrum = *state.mutable_frequency_spectrum();
      if (random() % 8 == 0) return spectrum.set_trusted_up_to(AnyNumber(random));
      if (random() % 8 == 0) return spectrum.set_record_length(AnyNumber(random));
      return MutateLists(random, spectrum, *spectrum.mutable_frequencies());
    }
    case v1::SeaState::kWavenumberSpectrum:
      return MutateLists(random, *state.mutable_wavenumber_spectrum(),
                         *state.mutable_wavenumber_spectrum()->mutable_wavenumbers());
    case v1::SeaState::WAVES_NOT_SET:
      state.mutable_components();
  }
}

void MutateRest(std::mt19937& random, v1::SeaState& state) {
  const double number = AnyNumber(random);
  switch (random() % 6) {
    case 0:
      return random() % 3 == 0 ? state.clear_wind_speed() : state.set_wind_speed(number);
    case 1:
      return random() % 3 == 0 ? state.clear_wind_from() : state.set_wind_from(number);
    case 2:
      return random() % 3 == 0 ? state.clear_water_depth() : state.set_water_depth(number);
    case 3:
      return random() % 3 == 0 ? state.clear_tail_from() : state.set_tail_from(number);
    case 4:
      return state.clear_waves();
    default:
      return state.set_tail_rule(static_cast<v1::TailRule>(random() % 6));
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  std::mt19937 random(seed);
  v1::SeaState state;
  const bool is_state = state.ParseFromArray(data, static_cast<int>(size));
  if (!is_state || random() % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
  random() % 3 == 0 ? MutateRest(random, state) : MutateWaves(random, state);
  return fuzz::Replace(state.SerializeAsString(), data, size, max_size);
}
