#include "service/client/wire.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "service/error_message.h"
#include "service/wire_values.h"

namespace albtpu::client {
namespace {

namespace v1 = albtpu::v1;

// On the wire, axes are numbered from 1, and 0 means none.
std::optional<AxisId> AxisOf(int number) {
  if (number < 1 || number > static_cast<int>(kAxisCount)) return std::nullopt;
  return kAxes[number - 1];
}

std::string Text(const v1::AttributeValue& value) {
  switch (value.value_case()) {
    case v1::AttributeValue::kText:
      return value.text();
    case v1::AttributeValue::kInteger:
      return absl::StrCat(value.integer());
    case v1::AttributeValue::kNumber:
      return absl::StrCat(value.number());
    case v1::AttributeValue::kNumbers:
      return absl::StrJoin(value.numbers().values(), ", ");
    case v1::AttributeValue::VALUE_NOT_SET:
      break;
  }
  return "";
}

v1::ForwardRightDown ForwardRightDown(const std::array<double, 3>& numbers) {
  v1::ForwardRightDown message;
  message.set_forward(numbers[0]);
  message.set_right(numbers[1]);
  message.set_down(numbers[2]);
  return message;
}

}  // namespace

void ToWire(const Query& query, const AnswerColumns& requested, v1::QueryColumnsRequest& request) {
  v1::QueryOptions& options = *request.mutable_options();
  options.set_coverage(ToWire(query.coverage));
  options.set_best_s44_order(requested.best_s44_orders != nullptr);
  options.set_s44_order(ToWire(query.s44_order));
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    if (requested.standard_errors[i] != nullptr) options.set_standard_errors(true);
    if (requested.values[i] == nullptr && requested.standard_errors[i] == nullptr) continue;
    request.add_quantities(ToWire(kQuantities[i]));
  }
}

void AddPulses(const PulseColumns& pulses, ColumnMessage& request) {
  const auto is_long = [](std::span<const float> column) { return column.size() > 1; };
  const bool all_constant = std::none_of(pulses.axis.begin(), pulses.axis.end(), is_long);
  const std::size_t mark = request.Mark();
  for (AxisId axis : kAxes) {
    const std::span<const float> column = pulses[axis];
    const std::size_t repeats = all_constant && axis == AxisId::kDepth ? pulses.size : 1;
    if (column.empty()) continue;
    char* bytes = request.AddColumn(ToWire(axis), repeats * column.size_bytes());  // Its field has the same number.
    for (std::size_t i = 0; i < repeats; ++i)
      std::memcpy(bytes + i * column.size_bytes(), column.data(), column.size_bytes());
  }
  request.Nest(v1::QueryColumnsRequest::kPulsesFieldNumber, mark);
}

bool Wants(const BudgetAnswers& wanted, BudgetQuantity quantity) {
  if (quantity == BudgetQuantity::kBestS44Order) return wanted.best_s44_orders != nullptr;
  const auto first = wanted.columns.begin() + static_cast<std::ptrdiff_t>(FirstColumn(quantity));
  return std::any_of(first, first + static_cast<std::ptrdiff_t>(ColumnCount(quantity)),
                     [](const float* column) { return column != nullptr; });
}

void ToWire(const BudgetOptions& options, const BudgetPulses& pulses, const BudgetAnswers& wanted,
            v1::QueryBudgetRequest& request) {
  v1::BudgetOptions& message = *request.mutable_options();
  message.set_coverage(ToWire(options.coverage));
  *message.mutable_errors() = ToMessage(options.errors);
  message.set_located(ToWire(options.located));
  *message.mutable_lever_arm() = ForwardRightDown(options.lever_arm);
  message.set_refractive_index(options.index);
  message.set_datum(options.datum);
  message.set_extra_horizontal(options.extra_horizontal);
  message.set_extra_vertical(options.extra_vertical);
  if (pulses.sea_axis.has_value()) message.set_sea_axis(*pulses.sea_axis);
  for (std::size_t i = 0; i < kBudgetQuantityCount; ++i)
    if (Wants(wanted, static_cast<BudgetQuantity>(i))) request.add_quantities(ToWire(static_cast<BudgetQuantity>(i)));
}

void AddPulses(const BudgetPulses& pulses, ColumnMessage& request) {
  static_assert(int{v1::QueryBudgetRequest::kPulsesFieldNumber} == int{v1::QueryColumnsRequest::kPulsesFieldNumber});
  AddPulses(pulses.pulses, request);
  const std::size_t mark = request.Mark();
  for (std::size_t i = 0; i < kAircraftInputs.size(); ++i) {
    const std::span<const float> column = pulses.aircraft[kAircraftInputs[i]];
    if (column.empty()) continue;
    std::memcpy(request.AddColumn(static_cast<int>(i) + 1, column.size_bytes()), column.data(), column.size_bytes());
  }
  request.Nest(v1::QueryBudgetRequest::kAircraftFieldNumber, mark);
}

TableSummary FromWire(const v1::Table& table) {
  TableSummary summary;
  summary.name = table.reference().name();
  summary.id = table.reference().id();
  summary.version = table.reference().version();
  summary.digest = table.reference().digest();
  summary.title = table.title();
  for (const v1::TableAxis& axis : table.axes()) {
    const std::optional<AxisId> id = AxisOf(axis.axis());
    if (!id.has_value() || axis.nodes().empty()) continue;
    summary.axes[Index(*id)] = {axis.nodes(0), axis.nodes(axis.nodes_size() - 1),
                                static_cast<std::size_t>(axis.nodes_size())};
  }
  for (const auto& [key, value] : table.attributes()) summary.attributes[key] = Text(value);
  if (table.has_sea()) summary.sea = FromWire(table.sea());
  return summary;
}

namespace {

namespace v1 = albtpu::v1;

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

v1::WaterState ToWire(const KnownWater& water) {
  v1::WaterState state;
  const OpticsInput& optics = water.optics;
  const auto set = [&state](const std::optional<double>& number, void (v1::WaterState::*setter)(double)) {
    if (number.has_value()) (state.*setter)(*number);
  };
  set(optics.kd, &v1::WaterState::set_kd);
  state.set_kd_kind(ToWire(optics.kd_kind));
  set(optics.secchi, &v1::WaterState::set_secchi);
  if (optics.jerlov.has_value()) {
    const auto type = std::find(kJerlovTypes.begin(), kJerlovTypes.end(), *optics.jerlov) - kJerlovTypes.begin();
    state.set_jerlov(static_cast<v1::JerlovType>(type + 1));
  }
  set(optics.absorption, &v1::WaterState::set_absorption);
  set(optics.scattering, &v1::WaterState::set_scattering);
  set(optics.kd_sigma, &v1::WaterState::set_kd_sigma);
  set(optics.omega0, &v1::WaterState::set_omega0);
  set(optics.omega0_sigma, &v1::WaterState::set_omega0_sigma);
  set(optics.backscatter_fraction, &v1::WaterState::set_backscatter_fraction);
  state.set_detector(ToWire(water.detector));
  if (water.field_of_view != 0) state.set_field_of_view(water.field_of_view);
  if (water.pulse_length != 0) state.set_pulse_length(water.pulse_length);
  state.set_without_column(!water.bias.has_value());
  if (water.bias.has_value()) {
    const BiasTreatment& bias = *water.bias;
    state.set_bias(ToWire(bias.handling));
    if (bias.handling == BiasHandling::kVendor) state.set_residual_fraction(bias.residual_fraction);
    if (bias.handling == BiasHandling::kCalibrated) {
      state.mutable_calibration()->set_depth(bias.calibration_depth);
      state.mutable_calibration()->set_offset(bias.calibration_offset);
      state.mutable_calibration()->set_sigma(bias.calibration_sigma);
    }
  }
  set(water.photons, &v1::WaterState::set_photons);
  set(water.temperature, &v1::WaterState::set_temperature);
  set(water.salinity, &v1::WaterState::set_salinity);
  set(water.processed_with, &v1::WaterState::set_processed_with);
  state.set_green_surface(water.green_surface);
  return state;
}

WaterSummary FromWire(const v1::WaterSummary& water) {
  return {.table_id = water.table().id(),
          .table_version = water.table().version(),
          .table_digest = water.table().digest(),
          .attenuation = water.attenuation(),
          .attenuation_log_sigma = water.attenuation_log_sigma(),
          .derivation = water.derivation(),
          .greatest_depth = water.greatest_depth(),
          .greatest_incidence = water.greatest_incidence(),
          .greatest_footprint = water.greatest_footprint(),
          .green_surface_range = water.green_surface_range(),
          .assumptions = {water.assumptions().begin(), water.assumptions().end()}};
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
