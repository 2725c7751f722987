// Common parts of the models of the wind sea: how a model describes itself, the spreading of the waves about the wind,
// the enhanced peak of a growing sea, and the wind profile over the water.
#pragma once

#include <limits>
#include <memory>
#include <string_view>

#include "sea/spectra/wave_spectrum.h"

namespace albtpu {

// D(psi) = C(s) cos^{2s}(psi / 2) [1/rad], psi in rad from downwind; its integral over a full turn is 1.
//
// Source: Birkebak et al. (2018), Eq. 15, after Mitsuyasu et al. (1975); s = 2 for short waves. With s = 2 the slope
// variances along and across the wind are in the ratio 7 to 5.
class Cosine2sSpreading {
 public:
  explicit Cosine2sSpreading(double s = 2);  // s above 0

  double operator()(double psi) const;

 private:
  double s_, normalization_;
};

// A spectrum model of the wind sea, before wind and fetch are known. kSpectrumModels of sea/sea_state.h lists all.
struct SpectrumModel {
  std::string_view key;     // in campaign files and on the command line: "apel"
  std::string_view author;  // in reports: "Apel"
  bool takes_spreading;     // false: the model has a spreading of its own

  // The shortest fetch [m] at which the model's sea counts as fully developed.
  double (*fully_developed_fetch)(double wind_speed_10m);

  // The spectrum for a wind [m/s, above 0] and a fetch [m, above 0; infinity means fully developed]. A model that
  // does not take a spreading ignores the one given.
  std::shared_ptr<const WaveSpectrum> (*make)(double wind_speed_10m, double fetch, const Cosine2sSpreading& spreading);
};

inline constexpr double kFullyDeveloped = std::numeric_limits<double>::infinity();  // m, as a fetch

// The inverse wave age (wind speed over the phase speed at the peak) of the fully developed sea; Elfouhaily et al.
// (1997), doi:10.1029/97JC00467, and Birkebak et al. (2018), Eq. 7.
inline constexpr double kFullyDevelopedOmega = 0.84;

// gamma^Gamma, the peak of a growing sea over that of a fully developed one: JONSWAP's enhancement with the widths of
// Donelan et al. (1985), for a sea of inverse wave age Omega.
//
// Source: Birkebak et al. (2018), Eq. 6-9; Elfouhaily et al. (1997), Eq. 3. The logarithm is of base 10. The formula
// is published for Omega from 1 to 5, but short fetches reach higher values: outside that range gamma keeps its end
// value.
class JonswapPeak {
 public:
  explicit JonswapPeak(double omega);

  // `ratio` is the wavenumber over that of the peak.
  double operator()(double ratio) const;

 private:
  double gamma_, sigma_;
};

// The friction velocity u* [m/s] by the drag law of Wu (1982), doi:10.1029/JC087iC12p09704: u*^2 = C U10^2,
// C = (0.8 + 0.065 U10) 1e-3 with the wind at 10 m in m/s.
double FrictionVelocity(double wind_speed_10m);

// The wind speed [m/s] at `height` [m] on the neutral logarithmic profile, with von Karman's constant 0.4.
double WindSpeedAt(double height, double wind_speed_10m);

}  // namespace albtpu
