#include "survey/answers/batch.h"

namespace albtpu::client {

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
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    columns.values[i] = column(values[i], selection.quantities[i]);
    columns.standard_errors[i] =
        column(standard_errors[i], selection.quantities[i] && selection.standard_errors);
  }
  columns.best_s44_orders = column(best_s44_orders, selection.best_s44_orders);
  columns.remaining_thu = column(remaining_thu, selection.s44_remaining);
  columns.remaining_tvu = column(remaining_tvu, selection.s44_remaining);
  return columns;
}

}  // namespace albtpu::client
