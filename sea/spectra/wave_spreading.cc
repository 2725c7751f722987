#include "sea/spectra/wave_spreading.h"

#include <cassert>
#include <cmath>

namespace albtpu {

std::array<double, kSeaHarmonics> Cosine2sHarmonics(double s) {
  assert(s >= 0);
  std::array<double, kSeaHarmonics> means;
  double product = 1;
  for (std::size_t n = 0; n < kSeaHarmonics; ++n) {
    for (const double j : {2.0 * static_cast<double>(n) + 1, 2.0 * static_cast<double>(n) + 2})
      if (!std::isinf(s)) product *= (s - j + 1) / (s + j);
    means[n] = product;
  }
  return means;
}

double Cosine2sOfSpread(double spread) {
  assert(spread >= 0 && spread * spread <= 2 + 1e-9);
  const double r1 = std::fmax(0, 1 - spread * spread / 2);
  return r1 / (1 - r1);
}

double MitsuyasuS(double f) { return 10 * std::pow(f, f <= 1 ? 5 : -2.5); }

}  // namespace albtpu
