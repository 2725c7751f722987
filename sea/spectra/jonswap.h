// Waves described by a height, a period and a direction: JONSWAP in deep water, TMA in shallow.
#pragma once

#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "sea/spectra/frequency_spectrum.h"

namespace albtpu {

// f^-5 exp(-1.25 (fp/f)^4) gamma^exp(-(f - fp)^2 / (2 (sigma fp)^2)), sigma 0.07 up to fp and 0.09 above, times
// tanh^2(k h) / (1 + 2 k h / sinh(2 k h)), scaled until its integral over all f is (hs / 4)^2.
//
// Source: Hasselmann et al. (1973), Dt. Hydrogr. Z. A8(12); Bouws et al. (1985), doi:10.1029/JC090iC01p00975, for the
// factor of depth, here that of Kitaigorodskii et al. (1975).
struct JonswapWaves {
  double significant_wave_height = 0;  // hs, m, from 0
  double peak_period = 0;              // 1 / fp, s, kShortestPeak to kLongestPeak
  double gamma = 3.3;                  // from 1; swell 5 to 10
  double travels_towards = 0;          // compass direction, rad
  std::optional<double> spread = {};   // rad, as Cosine2sOfSpread() has it; absent: MitsuyasuS()
};

// s. Of waves longer than the longest, seas (SeaWavenumbers) would lose height: 2 % at 25 s if gamma is 1, and 1 % of
// swell, but 10 % at 30 s.
inline constexpr double kShortestPeak = 0.5, kLongestPeak = 25;

// Our choice for swell of which only height, period and direction are known: narrow in frequency and in direction.
inline constexpr double kSwellGamma = 7;
inline constexpr double kSwellSpread = 18 * std::numbers::pi / 180;  // rad

// The sum of several such waves.
class JonswapSpectrum final : public FrequencySpectrum {
 public:
  explicit JonswapSpectrum(std::vector<JonswapWaves> waves,  // at least one
                           double depth = std::numeric_limits<double>::infinity());

  DirectionalEnergy operator()(double f) const override;
  std::optional<double> shortest_peak() const override;
  double highest_frequency() const override { return std::numeric_limits<double>::infinity(); }
  // 100 frequencies, equidistant in log f.
  std::vector<double> ComparedFrequencies(double lowest, double highest) const override;
  // 2.5 times the highest peak frequency, where the sea of one wind is in equilibrium, and not below 0.4 Hz, because
  // swell does not follow the wind. Both factors are our choice.
  double trusted_up_to() const override;
  double significant_wave_height() const override;
  double leading_axis() const override;  // that of the first waves
  std::optional<double> ShortWaveAxis(double f) const override;

  const std::vector<JonswapWaves>& waves() const { return waves_; }

 private:
  std::vector<JonswapWaves> waves_;
  double depth_;
  std::vector<double> scales_;  // of each, m^2 Hz^4
};

}  // namespace albtpu
