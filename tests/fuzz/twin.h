// Compares answers with those of the slow twin, `Interpolate`, pulse by pulse.
#pragma once

#include <array>

#include "tables/query/column_query.h"
#include "tables/query/pulse_columns.h"
#include "tables/uncertainty_table.h"

namespace albtpu::fuzz {

class Twin {
 public:
  explicit Twin(const UncertaintyTable& table);  // The table must outlive the twin.

  // Aborts unless the columns of `answers` that are not null have the outcomes and axes of the twin, its numbers within
  // the tolerance that `ColumnInterpolator` promises, and NaN where the twin has no number.
  void MustAgree(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers) const;

 private:
  const UncertaintyTable& table_;
  std::array<double, kQuantityCount> largest_{}, largest_error_{};  // Largest magnitudes, by quantity.
};

}  // namespace albtpu::fuzz
