// The cells of an answer: which columns there are, their order and their contents. CSV files and `pulse --json`
// share them.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "annotate/answers/batch.h"
#include "annotate/answers/outcome_counts.h"

namespace albtpu::annotate {

// Columns, in order:
//   refraction_along_wind, refraction_cross_wind  degree
//   thu, tvu, bias_along_beam, bias_vertical      m
//   outcome                                       "INTERPOLATED", "OUT_OF_DOMAIN:depth:above", "INVALID"
//   with standard errors:  <each of the six>_standard_error, in the same unit
//   with an S-44 order:
//     s44_best_order                              the strictest order that the sea surface alone leaves open;
//                                                 empty if there is none
//     s44_remaining_thu, s44_remaining_tvu        m at 95 %: what the order's limit leaves for all other error
//                                                 sources; empty if the sea surface alone exceeds it
class AnswerCells {
 public:
  explicit AnswerCells(AnswerStyle style);

  const std::vector<std::string>& names() const { return names_; }
  AnswerSelection selection() const;

  // Calls `number(float)`, `text(std::string_view)` or `nothing()` for each column in order.
  template <typename NumberCell, typename TextCell, typename EmptyCell>
  void Visit(const AnswerBatch& answers, std::size_t i, NumberCell number, TextCell text,
             EmptyCell nothing) const {
    const auto number_or_nothing = [&](float value) { std::isfinite(value) ? number(value) : nothing(); };
    for (const auto& column : answers.values) number_or_nothing(column[i]);
    text(OutcomeName(answers, i));
    if (style_.standard_errors) {
      for (const auto& column : answers.standard_errors) number_or_nothing(column[i]);
    }
    if (!style_.s44_order.has_value()) return;
    const std::uint8_t best = answers.best_s44_orders[i];
    best > 0 ? text(Name(kS44Orders[best - 1])) : nothing();
    number_or_nothing(answers.remaining_thu[i]);
    number_or_nothing(answers.remaining_tvu[i]);
  }

 private:
  AnswerStyle style_;
  std::vector<std::string> names_;
};

}  // namespace albtpu::annotate
