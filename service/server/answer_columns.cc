#include "service/server/answer_columns.h"

#include <cstring>
#include <limits>
#include <optional>

#include "service/server/wire_enums.h"

namespace albtpu::server {
namespace {

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

char* MakeBytes(std::string* column, std::size_t count) {
  column->resize(count);
  return column->data();
}

char* MakeFloats(std::string* column, std::size_t count) { return MakeBytes(column, count * sizeof(float)); }

// Columns that were not asked for are null.
void WriteFloat(char* column, std::size_t i, float value) {
  if (column != nullptr) std::memcpy(column + i * sizeof value, &value, sizeof value);
}

}  // namespace

absl::StatusOr<QuantitySelection> ReadQuantities(const v1::QueryColumnsRequest& request) {
  QuantitySelection selection;
  selection.fill(request.quantities_size() == 0);
  for (int number : request.quantities()) {
    const absl::StatusOr<Quantity> quantity = FromWire(static_cast<v1::Quantity>(number));
    if (!quantity.ok()) return quantity.status();
    selection[Index(*quantity)] = true;
  }
  return selection;
}

AnswerColumns::AnswerColumns(const Query& query, const QuantitySelection& selection,
                             const PulseColumns& pulses, v1::QueryColumnsResponse& response)
    : query_(query),
      pulses_(pulses),
      outcomes_(MakeBytes(response.mutable_outcomes(), pulses.size())),
      outcome_axes_(MakeBytes(response.mutable_outcome_axes(), pulses.size())) {
  response.set_pulse_count(static_cast<int>(pulses.size()));
  response.set_azimuth_absent(pulses.azimuth_absent());
  MakeSeaSurface(selection, *response.mutable_sea_surface(), values_);
  if (query.standard_errors) {
    MakeSeaSurface(selection, *response.mutable_sea_surface_standard_error(), standard_errors_);
  }
  if (query.asks_s44()) MakeS44(*response.mutable_s44());
}

void AnswerColumns::MakeSeaSurface(const QuantitySelection& selection, v1::SeaSurfaceColumns& message,
                                   SeaSurfaceColumns& columns) {
  using Column = std::string* (v1::SeaSurfaceColumns::*)();
  constexpr std::array<Column, kQuantityCount> kColumns = {
      &v1::SeaSurfaceColumns::mutable_refraction_along_wind,
      &v1::SeaSurfaceColumns::mutable_refraction_cross_wind,
      &v1::SeaSurfaceColumns::mutable_thu,
      &v1::SeaSurfaceColumns::mutable_tvu,
      &v1::SeaSurfaceColumns::mutable_bias_along_beam,
      &v1::SeaSurfaceColumns::mutable_bias_vertical};
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    if (selection[i]) columns[i] = MakeFloats((message.*kColumns[i])(), pulses_.size());
  }
}

void AnswerColumns::MakeS44(v1::S44Columns& message) {
  if (query_.best_s44_order) best_orders_ = MakeBytes(message.mutable_best_orders(), pulses_.size());
  if (query_.s44_order.has_value()) {
    remaining_thu_ = MakeFloats(message.mutable_remaining_thu(), pulses_.size());
    remaining_tvu_ = MakeFloats(message.mutable_remaining_tvu(), pulses_.size());
  }
}

void AnswerColumns::Fill(std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    const PulseAnswer answer = AnswerPulse(query_, pulses_[i]);
    outcomes_[i] = static_cast<char>(ToWire(answer.uncertainty.outcome));
    outcome_axes_[i] = static_cast<char>(ToWire(answer.uncertainty.axis));
    for (std::size_t q = 0; q < kQuantityCount; ++q) {
      WriteFloat(values_[q], i, answer.uncertainty.values[q]);
      WriteFloat(standard_errors_[q], i, answer.uncertainty.standard_errors[q]);
    }
    if (query_.asks_s44()) WriteS44(i, answer.s44);
  }
}

void AnswerColumns::WriteS44(std::size_t i, const S44Answer& answer) {
  if (best_orders_ != nullptr) best_orders_[i] = static_cast<char>(ToWire(answer.best_order));
  WriteFloat(remaining_thu_, i, answer.remaining_thu.value_or(kNoNumber));
  WriteFloat(remaining_tvu_, i, answer.remaining_tvu.value_or(kNoNumber));
}

}  // namespace albtpu::server
