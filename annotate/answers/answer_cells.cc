#include "annotate/answers/answer_cells.h"

namespace albtpu::annotate {

AnswerCells::AnswerCells(AnswerStyle style) : style_(style) {
  for (const Quantity quantity : kQuantities) names_.emplace_back(Describe(quantity).name);
  names_.emplace_back("outcome");
  if (style_.standard_errors) {
    for (const Quantity quantity : kQuantities) {
      names_.push_back(std::string(Describe(quantity).name) + std::string(kStandardErrorSuffix));
    }
  }
  if (style_.s44_order.has_value()) {
    names_.insert(names_.end(), {"s44_best_order", "s44_remaining_thu", "s44_remaining_tvu"});
  }
}

AnswerSelection AnswerCells::selection() const {
  AnswerSelection selection;
  selection.quantities.fill(true);
  selection.standard_errors = style_.standard_errors;
  selection.best_s44_orders = selection.s44_remaining = style_.s44_order.has_value();
  return selection;
}

}  // namespace albtpu::annotate
