// Arbitrary bytes as the sea of a query are refused with the paths of wrong fields, or are a sea that has a table, or
// whose numbers no table can hold.
#include <string>
#include <vector>

#include "albtpu/v1/sea.pb.h"
#include "sea/table/sea_table.h"
#include "service/client/wire.h"
#include "service/seas/sea_summary.h"
#include "service/server/calls/sea_request.h"
#include "tests/fuzz/fuzz_target.h"

namespace albtpu::fuzz {
namespace {

void SeaStateTarget(std::string_view input) {
  // A few beams: a sea is refused or not whatever the nodes of its table.
  static const SeaCompiler compiler(
      {.nodes = {.incidences = {0, 20}, .azimuths = {0, 90, 180}, .footprints = {0.5}, .depths = {0, 10}}});
  v1::SeaState state;
  if (!state.ParseFromArray(input.data(), static_cast<int>(input.size()))) return;
  const absl::StatusOr<KnownSea> sea = server::ReadSea(state);
  if (!sea.ok()) {
    ALBTPU_MUST(absl::IsInvalidArgument(sea.status()) && !sea.status().message().empty());
    ALBTPU_MUST(sea.status().GetPayload("type.googleapis.com/google.rpc.BadRequest").has_value());
    return;
  }
  const absl::StatusOr<KnownSea> same = server::ReadSea(client::ToWire(*sea));
  ALBTPU_MUST(same.ok());
  ALBTPU_MUST(client::ToWire(*same).SerializeAsString() == client::ToWire(*sea).SerializeAsString());
  if (!IsOneIn(1024, input)) return;  // A table takes a thousand times as long as the rest.
  const absl::StatusOr<UncertaintyTable> table = CompileSea(compiler, *sea);
  ALBTPU_MUST(table.ok() || absl::IsInvalidArgument(table.status()));
  if (!table.ok()) return;
  const SeaSummary summary = SummaryOfSea(*table).value();
  ALBTPU_MUST(summary.x_azimuth >= 0 && summary.x_azimuth <= 360);
  ALBTPU_MUST(summary.significant_wave_height >= 0);
  ALBTPU_MUST(summary.share_measured >= 0 && summary.share_measured <= 1 + 1e-9);
}

using Numbers = google::protobuf::RepeatedField<double>;

double AnyNumber(Random& random) {
  if (random() % 2 == 0) return NotableNumber<double>(random);
  return static_cast<double>(random()) / double{Random::max()} * (random() % 2 == 0 ? 1 : 20);
}

void Mutate(Random& random, Numbers& numbers) {
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

void Mutate(Random& random, v1::WaveComponent& waves) {
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
void MutateLists(Random& random, Spectrum& spectrum, Numbers& axis) {
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

void MutateWaves(Random& random, v1::SeaState& state) {
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

void MutateRest(Random& random, v1::SeaState& state) {
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

// Field by field, so that most seas stay valid messages.
std::string MutateSea(std::string_view input, std::size_t, Random& random) {
  v1::SeaState state;
  const bool is_state = state.ParseFromArray(input.data(), static_cast<int>(input.size()));
  if (!is_state || random() % 8 == 0) return "";
  random() % 3 == 0 ? MutateRest(random, state) : MutateWaves(random, state);
  return state.SerializeAsString();
}

}  // namespace

const std::vector<Target> kTargets = {{"sea_state", SeaStateTarget, MutateSea}};

}  // namespace albtpu::fuzz
