// What an oceanographer makes of a record of elevations: spectrum, peak and significant wave height.
#pragma once

#include <vector>

namespace albtpu {

// A one-sided spectrum of variance on equidistant frequencies from 0.
struct RecordSpectrum {
  double resolution;                     // Hz, between frequencies
  std::vector<double> density;           // m^2/Hz
  double PeakFrequency() const;          // Hz, of the highest density
  double SignificantWaveHeight() const;  // m, four times the root of the variance
};

// Welch's method: the mean of the periodograms of segments of `segment` samples (a power of two) under
// Hann's window, each half over the last, without their means. A record of elevations [m] at `rate` [Hz],
// at least one segment long.
RecordSpectrum WelchSpectrum(const std::vector<double>& record, double rate, int segment);

// The mean height [m], trough to crest, of the highest third of the waves between upward crossings of the
// mean. At least three waves.
double HighestThird(const std::vector<double>& record);

}  // namespace albtpu
