#include "validation/laboratory/frequency_spectrum.h"

#include <cmath>
#include <numbers>

#include "validation/laboratory/dispersion.h"

namespace albtpu {

double FrequencySpectrum(const SeaState& sea, double frequency) {
  const double k = Wavenumber(2 * std::numbers::pi * frequency);
  return 2 * std::numbers::pi * sea.S(k) / GroupSpeed(k);
}

double PeakFrequency(const SeaState& sea) {
  constexpr double kStep = 1e-4;  // of the logarithm of the frequency
  const auto [lowest, highest] = sea.energetic_range();
  const double first = AngularFrequency(lowest) / (2 * std::numbers::pi);
  const double last = AngularFrequency(highest) / (2 * std::numbers::pi);
  double peak = first, height = 0;
  for (double f = first; f <= last; f *= 1 + kStep) {
    const double here = FrequencySpectrum(sea, f);
    if (here > height) {
      peak = f;
      height = here;
    }
  }
  return peak;
}

}  // namespace albtpu
