#include "service/client/answer_columns.h"

#include <cmath>

#include "tables/schema.h"

namespace albtpu::client {
namespace {

AnswerCell NumberOrNothing(float value) {
  if (!std::isfinite(value)) return std::monostate();
  return value;
}

AnswerCell NumberOrNothing(std::optional<double> value) {
  if (!value.has_value()) return std::monostate();
  return NumberOrNothing(static_cast<float>(*value));
}

void AppendS44(S44Order order, const Pulse& pulse, const PulseUncertainty& two_sigma,
               std::vector<AnswerCell>& cells) {
  if (two_sigma.outcome != Outcome::kInterpolated) {
    cells.insert(cells.end(), 3, std::monostate());
    return;
  }
  const PulseUncertainty p95 = WithCoverage(two_sigma, Coverage::kP95);
  const double thu = p95[Quantity::kThu], tvu = p95[Quantity::kTvu];
  const std::optional<S44Order> best = BestOrder(thu, tvu, pulse.depth);
  cells.push_back(best.has_value() ? AnswerCell(std::string(Name(*best))) : std::monostate());
  cells.push_back(NumberOrNothing(RemainingBudget(ThuLimit(order, pulse.depth), thu)));
  cells.push_back(NumberOrNothing(RemainingBudget(TvuLimit(order, pulse.depth), tvu)));
}

}  // namespace

AnswerColumns::AnswerColumns(AnswerStyle style) : style_(style) {
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

std::vector<AnswerCell> AnswerColumns::Cells(const Pulse& pulse, const PulseUncertainty& two_sigma) const {
  const PulseUncertainty uncertainty = WithCoverage(two_sigma, style_.coverage);
  std::vector<AnswerCell> cells;
  cells.reserve(names_.size());
  for (const float value : uncertainty.values) cells.push_back(NumberOrNothing(value));
  cells.emplace_back(OutcomeText(uncertainty));
  if (style_.standard_errors) {
    for (const float error : uncertainty.standard_errors) cells.push_back(NumberOrNothing(error));
  }
  if (style_.s44_order.has_value()) AppendS44(*style_.s44_order, pulse, two_sigma, cells);
  return cells;
}

}  // namespace albtpu::client
