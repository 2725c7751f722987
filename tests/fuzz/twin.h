// Answers held against those of the slow twin, `Interpolate`, pulse by pulse.
#pragma once

#include <array>

#include "tables/query/column_query.h"
#include "tables/query/pulse_columns.h"
#include "tables/uncertainty_table.h"

namespace albtpu::fuzz {

class Twin {
 public:
  explicit Twin(const UncertaintyTable& table);  // Which must outlive it.

  // Ends the program unless the columns of `answers` that are not null hold the outcomes and axes of the twin,
  // its numbers within the tolerance that `ColumnInterpolator` promises, and not-a-number where there is none.
  void MustAnswerAlike(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers) const;

 private:
  const UncertaintyTable& table_;
  std::array<double, kQuantityCount> largest_{}, largest_error_{};  // Sizes of the numbers of a quantity.
};

}  // namespace albtpu::fuzz
