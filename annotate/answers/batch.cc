#include "annotate/answers/batch.h"

#include <cmath>
#include <numbers>

#include "sea/table/sea_attributes.h"
#include "tables/pulse.h"

namespace albtpu::annotate {
PulseColumns PulseBatch::columns() const {
  PulseColumns columns{.size = size, .axis = {}};
  for (std::size_t i = 0; i < kAxisCount; ++i) columns.axis[i] = axis[i];
  return columns;
}

AnswerColumns AnswerBatch::Resize(std::size_t count, const AnswerSelection& selection) {
  const auto column = [count](auto& elements, bool selected) {
    elements.resize(selected ? count : 0);
    return selected ? elements.data() : nullptr;
  };
  AnswerColumns columns;
  columns.outcomes = column(outcomes, true);
  columns.outcome_axes = column(outcome_axes, true);
  sides.assign(count, 0);
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    columns.values[i] = column(values[i], selection.quantities[i]);
    columns.standard_errors[i] = column(standard_errors[i], selection.quantities[i] && selection.standard_errors);
  }
  columns.best_s44_orders = column(best_s44_orders, selection.best_s44_orders);
  columns.remaining_thu = column(remaining_thu, selection.s44_remaining);
  columns.remaining_tvu = column(remaining_tvu, selection.s44_remaining);
  sea_axes.clear();
  wave_heights.clear();
  return columns;
}

void AnswerBatch::FindSides(const PulseBatch& pulses, const TableAxes& axes) {
  constexpr std::uint8_t kOutOfDomain = 2;
  for (std::size_t i = 0; i < pulses.size; ++i) {
    if (outcomes[i] != kOutOfDomain || outcome_axes[i] == 0) continue;
    const AxisId id = kAxes[outcome_axes[i] - 1];
    if (pulses.axis[Index(id)].empty()) continue;  // No azimuth.
    const std::optional<Side> side = SideOf(Describe(id), axes[Index(id)].last, pulses.coordinate(id, i));
    if (side.has_value()) sides[i] = static_cast<std::uint8_t>(static_cast<int>(*side) + 1);
  }
}

namespace {

// The table of a sea counts azimuths counter-clockwise from its x axis, which is downwind, and needs no wind.
absl::Status AskSea(client::UncertaintySource& sea, const Query& query, const PulseBatch& pulses,
                    const AnswerColumns& answers) {
  const double zero = pulses.azimuths_from_north ? sea.table().sea->x_azimuth : 0;
  std::vector<float> azimuths = pulses.axis[Index(AxisId::kAzimuth)];
  for (float& azimuth : azimuths) azimuth = static_cast<float>(BeamAzimuth(azimuth, zero));
  PulseColumns columns = pulses.columns();
  columns.axis[Index(AxisId::kAzimuth)] = azimuths;
  columns.axis[Index(AxisId::kWindSpeed)] = columns.axis[Index(AxisId::kFetch)] = {};
  return sea.Answer(query, columns, answers);
}

}  // namespace

AnswerSource::AnswerSource(client::UncertaintySource& source)
    : AnswerSource(
          source.table(),
          [&source](const Query& query, const PulseBatch& pulses, const AnswerSelection& selection,
                    AnswerBatch& answers) {
            const AnswerColumns columns = answers.Resize(pulses.size, selection);
            if (const std::optional<SeaSummary>& sea = source.table().sea; sea.has_value()) {
              if (selection.sea_frame) {
                answers.sea_axes.assign(pulses.size, static_cast<float>(sea->x_azimuth));
                answers.wave_heights.assign(pulses.size, static_cast<float>(sea->significant_wave_height / 4));
              }
              return AskSea(source, query, pulses, columns);
            }
            return source.Answer(query, pulses.columns(), columns);
          },
          source.in_process()) {}

absl::Status AnswerPulses(const AnswerSource& source, const Query& query, const PulseBatch& pulses,
                          const AnswerSelection& selection, AnswerBatch& answers) {
  if (pulses.size == 0) {
    answers.Resize(0, selection);
    return absl::OkStatus();
  }
  absl::Status status = source.answer_(query, pulses, selection, answers);
  if (status.ok()) answers.FindSides(pulses, source.table().axes);
  return status;
}

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
constexpr double kRadiansPerMilliradian = 1e-3;

}  // namespace

double FootprintAtIncidence(double altitude, double divergence, double incidence) {
  return altitude / std::cos(incidence * kRadiansPerDegree) * (divergence * kRadiansPerMilliradian);
}

double DegreesFromDownwind(double beam_azimuth, double wind_from) { return beam_azimuth - (wind_from + 180); }

}  // namespace albtpu::annotate
