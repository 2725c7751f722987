// The answer at an axis whose coordinate is absent and whose alternatives count (Axis::alternatives).
#pragma once

#include <cmath>
#include <cstddef>

#include "tables/pulse.h"

namespace albtpu {

// From the answers at two of them: each value is the larger in magnitude, with its standard error. Without numbers at
// both, the answer that has the worse outcome: kInvalid before kOutOfDomain, then the one whose axis comes first.
// `Answer` has the members `outcome`, `axis`, `values` and `standard_errors`; the others are those of one of the two.
template <typename Answer>
Answer LargerAnswer(const Answer& low, const Answer& high) {
  if (low.outcome != high.outcome) return low.outcome > high.outcome ? low : high;
  if (low.outcome != Outcome::kInterpolated) return low.axis <= high.axis ? low : high;
  Answer larger = low;
  for (std::size_t q = 0; q < larger.values.size(); ++q) {
    if (!(std::abs(high.values[q]) > std::abs(low.values[q]))) continue;
    larger.values[q] = high.values[q];
    larger.standard_errors[q] = high.standard_errors[q];
  }
  return larger;
}

}  // namespace albtpu
