// The sea as a wave staff sees it: how the variance of elevation at one point lies over frequency.
#pragma once

#include <cstdint>
#include <vector>

#include "generator/random_stream.h"
#include "generator/sea_state.h"

namespace albtpu {

// S(f) = 2 pi S(k) / (d omega / d k) [m^2/Hz] with k from the dispersion: its integral over f is that of S(k)
// over k. `frequency` in Hz, above 0.
double FrequencySpectrum(const SeaState& sea, double frequency);

// Where it is highest, Hz.
double PeakFrequency(const SeaState& sea);

// The elevation [m] at one point, `samples` times at `rate` [Hz]: exactly Gaussian, with the sea's frequency
// spectrum. It is cut from a periodic record twice as long, so that it does not repeat. The instrument is quick:
// waves above half the rate are not filtered out but fold into the record, as they do at a staff.
std::vector<double> StaffRecord(const SeaState& sea, int samples, double rate, NormalStream stream);

}  // namespace albtpu
