// The waves shorter than instruments and models resolve: the spectrum of Elfouhaily et al. for the wind, joined to the
// resolved waves at a cut-off.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "sea/spectra/elfouhaily_spectrum.h"
#include "sea/spectra/frequency_spectrum.h"

namespace albtpu {

// How far the level of the resolved waves at the cut-off, q times that of the wind's spectrum, counts above it.
enum class TailRule {
  kWind,   // not at all: short waves follow the wind
  kRelax,  // less with every octave, not at all from ten times the cut-off wavenumber on
  kLevel,  // throughout
  kNone,   // there are no waves above the cut-off
};
std::string_view Name(TailRule rule);  // "wind", "relax", "level", "none"
std::optional<TailRule> FindTailRule(std::string_view name);

// The weight of the tail at `k`: from 0 through 1/2 at `cutoff` [rad/m] to 1. Its width is our choice: nine tenths of
// the change lie within 25 % of the cut-off.
double TailWeight(double k, double cutoff);

// The power of q by which the wind's spectrum at `k` is multiplied: 0, max(0, 1 - log10(k / cutoff)), or 1.
double LevelPower(TailRule rule, double k, double cutoff);

// The waves of the wind alone: the result of Sampled(), computed from the one harmonic of this spectrum, Delta / 2.
HarmonicSpectrum WindWaves(const ElfouhailySpectrum& wind, const std::vector<double>& wavenumbers);

// q, the geometric mean of the resolved over the wind's S(k) between 0.75 `tail_from` and `tail_from` [Hz], limited to
// 0.5 to 2. Both ranges are our choice: a few noisy bins shall not decide all short waves.
struct TailLevel {
  double q = 1;
  int compared = 0;   // frequencies with energy in both; with none, q is 1
  bool held = false;  // the mean lay outside 0.5 to 2
};
TailLevel LevelAtCutoff(const FrequencySpectrum& resolved, const ElfouhailySpectrum& wind, double depth,
                        double tail_from);

}  // namespace albtpu
