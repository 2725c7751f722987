// How the variance of elevation at one point of the sea lies over frequency.
#pragma once

#include "sea/sea_state.h"

namespace albtpu {

// S(f) = 2 pi S(k) / (d omega / d k) [m^2/Hz] with k from the dispersion: its integral over f is that of S(k)
// over k. `frequency` in Hz, above 0.
double FrequencySpectrum(const SeaState& sea, double frequency);

// Where it is highest, Hz.
double PeakFrequency(const SeaState& sea);

}  // namespace albtpu
