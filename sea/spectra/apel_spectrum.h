// Apel's spectrum of wind waves.
#pragma once

#include "sea/spectra/wind_sea.h"

namespace albtpu {

// JONSWAP peak, high-pass roll-off, capillary-gravity resonance; one cosine-2S spreading for waves of all lengths.
//
// Source: Birkebak et al. (2018), doi:10.3390/rs10030453, Eq. 1-14, after Apel (1994), doi:10.1029/94JC00846.
// Eq. 2 is printed with k/k_p inverted, Eq. 14 with a lost decimal point and an inverted root; all are read
// as in Apel.
//
// Compared with measured seas: fully developed it has 0.95 of the significant wave height of Pierson and Moskowitz
// (0.0214 s2/m times the square of the wind at 10 m; their law is for the wind at 19.5 m, and of that height it has
// 0.84-0.86) and 1.6-2.7 times the mean square slope of Cox and Munk (1954); at fetches below some 10 km its
// waves are 2-3 times lower than JONSWAP's, because A does not depend on fetch.
//
// Example: the significant wave height at 10 m/s, fully developed, is 4 * sqrt(integral of S) = 2.04 m.
class ApelSpectrum final : public WaveSpectrum {
 public:
  // `fetch` in m, above 0; infinity means fully developed. Requires wind_speed_10m > 0 [m/s].
  ApelSpectrum(double wind_speed_10m, double fetch, Cosine2sSpreading spreading = Cosine2sSpreading());

  double operator()(double k) const override;
  double Spreading(double, double psi) const override { return spreading_(psi); }
  bool spreading_varies_with_wavenumber() const override { return false; }
  double peak_wavenumber() const override { return k_p_; }  // Eq. 3
  WavenumberRange energetic_range() const override;
  std::string name() const override;
  std::string reference() const override;
  std::string departures() const override;

  // The inverse wave age of Eq. 5, never below that of the fully developed sea, 0.84.
  static double InverseWaveAge(double wind_speed_10m, double fetch);

  // The shortest fetch [m] at which the sea is fully developed: Eq. 5 solved for the fetch at Omega = 0.84.
  static double FullyDevelopedFetch(double wind_speed_10m);

 private:
  double omega_, k_p_, s_;
  JonswapPeak peak_;
  Cosine2sSpreading spreading_;
};

inline constexpr SpectrumModel kApelModel = {
    .key = "apel",
    .author = "Apel",
    .takes_spreading = true,
    .fully_developed_fetch = ApelSpectrum::FullyDevelopedFetch,
    .make = [](double wind_speed_10m, double fetch,
               const Cosine2sSpreading& spreading) -> std::shared_ptr<const WaveSpectrum> {
      return std::make_shared<ApelSpectrum>(wind_speed_10m, fetch, spreading);
    }};

}  // namespace albtpu
