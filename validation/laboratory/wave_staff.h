// A wave staff, which records the elevation at one point of an evolving sea; the dispersion of these waves; and the
// usual analysis of such a record: spectrum, peak and significant wave height.
#pragma once

#include <vector>

#include "generator/math/random_stream.h"
#include "sea/sea_state.h"
#include "sea/spectra/spectrum_moments.h"

namespace albtpu {

// The dispersion of AngularFrequency() in deep water, and the spectrum over frequency that follows. In the tank of
// Birkebak et al. (2018), 2.4 m deep, the factor tanh(k h) is below 1 by 1e-9 for waves of 1.4 m and by less for
// shorter ones.

double Wavenumber(double angular_frequency);  // rad/m, of omega in rad/s, not negative: the inverse
double GroupSpeed(double wavenumber);         // d omega / d k, m/s; k above 0

// The spectrum of elevation over frequency at one point, S(f) = 2 pi S(k) / (d omega / d k) [m^2/Hz], with k from the
// dispersion: its integral over f is that of S(k) over k. `frequency` in Hz, above 0.
double FrequencySpectrum(const SeaState& sea, double frequency);

// The frequency [Hz] of its maximum.
double PeakFrequency(const SeaState& sea);

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
