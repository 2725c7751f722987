#include "budget/water/refractive_index.h"

#include <cmath>

namespace albtpu {

WaterIndex SeaWaterIndex(double temperature, double salinity, double wavelength) {
  const double t = temperature, s = salinity, l = wavelength;
  // In powers of 1 / wavelength; each power is weighted by its exponent plus 1 in the group index.
  const double constant = 1.31405 + (1.779e-4 - 1.05e-6 * t + 1.6e-8 * t * t) * s - 2.02e-6 * t * t;
  const double first = (15.868 + 0.01155 * s - 0.00423 * t) / l;
  const double second = -4382 / (l * l), third = 1.1455e6 / (l * l * l);
  return {.phase = constant + first + second + third, .group = constant + 2 * first + 3 * second + 4 * third};
}

IndexBias BiasOfIndex(double incidence, const WaterIndex& water, double used) {
  const double sine = std::sin(incidence) / water.phase, cosine = std::sqrt(1 - sine * sine);
  const double sine_used = std::sin(incidence) / used, cosine_used = std::sqrt(1 - sine_used * sine_used);
  // The true length of the ray in water, over the reported depth.
  const double path = used / (water.group * cosine_used);
  return {.vertical = path * cosine - 1, .along = sine_used / cosine_used - path * sine};
}

}  // namespace albtpu
