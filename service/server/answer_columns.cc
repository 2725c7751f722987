#include "service/server/answer_columns.h"

#include <array>
#include <cstdint>
#include <string>

#include "absl/status/statusor.h"
#include "service/server/pulse_columns.h"
#include "service/server/question.h"
#include "service/server/table_messages.h"
#include "service/server/wire_enums.h"

namespace albtpu::server {
namespace {

using QuantitySelection = std::array<bool, kQuantityCount>;

// The quantities that a request names; all if it names none.
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

std::uint8_t* Bytes(std::string& column, std::size_t count) {
  column.resize(count);
  return reinterpret_cast<std::uint8_t*>(column.data());
}

float* Floats(std::string& column, std::size_t count) {
  column.resize(count * sizeof(float));
  return reinterpret_cast<float*>(column.data());  // Aligned as those of `ReadColumns`.
}

std::array<float*, kQuantityCount> Columns(const QuantitySelection& selection, std::size_t count,
                                           v1::SeaSurfaceColumns& message) {
  using Column = std::string* (v1::SeaSurfaceColumns::*)();
  constexpr std::array<Column, kQuantityCount> kColumns = {
      &v1::SeaSurfaceColumns::mutable_refraction_along_wind,
      &v1::SeaSurfaceColumns::mutable_refraction_cross_wind,
      &v1::SeaSurfaceColumns::mutable_thu,
      &v1::SeaSurfaceColumns::mutable_tvu,
      &v1::SeaSurfaceColumns::mutable_bias_along_beam,
      &v1::SeaSurfaceColumns::mutable_bias_vertical};
  std::array<float*, kQuantityCount> columns{};
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    if (selection[i]) columns[i] = Floats(*(message.*kColumns[i])(), count);
  }
  return columns;
}

// Columns of the message at full length, and those alone that were asked for.
AnswerColumns MakeColumns(const Question& question, const QuantitySelection& selection, std::size_t count,
                          v1::QueryColumnsResponse& response) {
  AnswerColumns columns;
  columns.outcomes = Bytes(*response.mutable_outcomes(), count);
  columns.outcome_axes = Bytes(*response.mutable_outcome_axes(), count);
  columns.values = Columns(selection, count, *response.mutable_sea_surface());
  if (question.standard_errors) {
    columns.standard_errors = Columns(selection, count, *response.mutable_sea_surface_standard_error());
  }
  if (!question.asks_s44()) return columns;
  v1::S44Columns& s44 = *response.mutable_s44();
  if (question.best_s44_order) columns.best_s44_orders = Bytes(*s44.mutable_best_orders(), count);
  if (question.query.s44_order.has_value()) {
    columns.remaining_thu = Floats(*s44.mutable_remaining_thu(), count);
    columns.remaining_tvu = Floats(*s44.mutable_remaining_tvu(), count);
  }
  return columns;
}

}  // namespace

absl::Status AnswerInColumns(const TableCatalog& catalog, const v1::QueryColumnsRequest& request,
                             v1::QueryColumnsResponse& response) {
  const absl::StatusOr<Question> question = ReadOptions(request.options(), catalog);
  if (!question.ok()) return question.status();
  const absl::StatusOr<QuantitySelection> selection = ReadQuantities(request);
  if (!selection.ok()) return selection.status();
  const absl::StatusOr<PulseColumns> pulses = ReadColumns(request.pulses());
  if (!pulses.ok()) return pulses.status();
  *response.mutable_table() = WriteReference(*question->source);
  response.set_coverage(ToWire(question->query.coverage));
  response.set_pulse_count(static_cast<int>(pulses->size));
  response.set_azimuth_absent((*pulses)[AxisId::kAzimuth].empty());
  AnswerOnAllCores(question->source->interpolator, question->query, *pulses,
                   MakeColumns(*question, *selection, pulses->size, response));
  return absl::OkStatus();
}

}  // namespace albtpu::server
