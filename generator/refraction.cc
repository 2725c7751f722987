#include "generator/refraction.h"

namespace albtpu {

double StillWaterRefraction(double incidence, double n) { return std::asin(std::sin(incidence) / n); }

SlopeGain SmallSlopeGain(double incidence, double n) {
  const double cos_refracted = std::cos(StillWaterRefraction(incidence, n));
  const double g = 1 - std::cos(incidence) / (n * cos_refracted);
  return {g / (cos_refracted * cos_refracted), g};
}

}  // namespace albtpu
