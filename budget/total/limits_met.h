// The orders of S-44 that a total uncertainty meets.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "tables/s44.h"

namespace albtpu {

// 1 plus the number of the strictest order (kS44Orders) whose limits exceed `thu` and `tvu`, both at 95 %, each plus
// the magnitude of the bias that was not corrected: U = k sigma + |b|, Guide to the Expression of Uncertainty in
// Measurement (JCGM 100:2008), F.2.4.5. 0 if there is none, or a number is NaN. All in m.
inline std::uint8_t BestOrderMet(double thu, double tvu, double bias_along_beam, double bias_vertical,
                                 double depth) {
  const std::optional<S44Order> order =
      BestOrder(thu + std::abs(bias_along_beam), tvu + std::abs(bias_vertical), depth);
  return order.has_value() ? static_cast<std::uint8_t>(static_cast<int>(*order) + 1) : 0;
}

}  // namespace albtpu
