// A wave staff, which records the elevation at one point of an evolving sea, and the usual analysis of such a record:
// spectrum, peak and significant wave height.
#pragma once

#include <vector>

#include "generator/math/random_stream.h"
#include "sea/sea_state.h"

namespace albtpu {

// Immutable; many threads may draw from one staff. Records are exactly Gaussian, with the sea's
// spectrum over frequency: at one point the directions of waves do not matter. Each record is cut from a periodic
// one twice as long, so that it does not repeat. The staff does not filter: waves above half the sampling rate alias
// into the record.
class WaveStaff {
 public:
  WaveStaff(const SeaState& sea, int samples, double rate);  // rate in Hz

  std::vector<double> Draw(NormalStream stream) const;  // m

 private:
  int samples_;
  std::vector<double> power_;  // m^2, by the number of cycles in the period, modulo its samples
};

// A one-sided spectrum of variance on equidistant frequencies from 0.
struct RecordSpectrum {
  double resolution;                     // Hz, between frequencies
  std::vector<double> density;           // m^2/Hz
  double PeakFrequency() const;          // Hz, of the highest density
  double SignificantWaveHeight() const;  // m, four times the root of the variance
};

// Welch's method: the mean of the periodograms of half-overlapping segments of `segment` samples (a power of two),
// each less its mean and under a Hann window. `record` holds elevations [m] at `rate` [Hz] and is at least one
// segment long.
RecordSpectrum WelchSpectrum(const std::vector<double>& record, double rate, int segment);

// The mean height [m], trough to crest, of the highest third of the waves between upward crossings of the
// mean level. The record must hold at least three waves.
double HighestThird(const std::vector<double>& record);

}  // namespace albtpu
