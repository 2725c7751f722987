// The unified spectrum of long and short wind waves of Elfouhaily et al.
#pragma once

#include "sea/spectra/wind_sea.h"

namespace albtpu {

// S(k) = k^-3 (B_l + B_h): curvature spectra of long waves after JONSWAP and of short ones after the slopes
// of Cox and Munk (1954), with a spreading of its own, the same for waves with and against the wind.
//
// Source: Elfouhaily, Chapron, Katsaros and Vandemark (1997), doi:10.1029/97JC00467; equation numbers are
// theirs. The friction velocity is Wu's (wind_sea.h), as is usual with this spectrum since McDaniel (2001), Waves in
// Random Media 11, 343-360.
//
// Below a wind of some 2.75 m/s Eq. 44 would make the curvature of the short waves negative: the spectrum then has no
// short waves.
class ElfouhailySpectrum final : public WaveSpectrum {
 public:
  // `fetch` in m, above 0; infinity means fully developed. Requires wind_speed_10m > 0 [m/s].
  ElfouhailySpectrum(double wind_speed_10m, double fetch);

  double operator()(double k) const override;             // Eq. 30
  double Spreading(double k, double psi) const override;  // Eq. 49
  bool spreading_varies_with_wavenumber() const override { return true; }
  double peak_wavenumber() const override { return k_p_; }
  WavenumberRange energetic_range() const override;
  std::string name() const override;
  std::string reference() const override;
  std::string departures() const override;

  // (D along - D across) / (D along + D across) of the waves of wavenumber `k`: Eq. 57.
  double Delta(double k) const;

  double friction_velocity() const { return friction_velocity_; }  // m/s

  // Eq. 37.
  static double InverseWaveAge(double wind_speed_10m, double fetch);

  // The fetch [m] beyond which the sea counts as fully developed. Eq. 37 reaches 0.84 only in the limit; at this
  // fetch Omega is within 1 % of it.
  static double FullyDevelopedFetch(double wind_speed_10m);

 private:
  double omega_, k_p_, c_p_, alpha_p_;
  JonswapPeak peak_;
  double friction_velocity_, alpha_m_;
};

inline constexpr SpectrumModel kElfouhailyModel = {
    .key = "elfouhaily",
    .author = "Elfouhaily",
    .takes_spreading = false,
    .fully_developed_fetch = ElfouhailySpectrum::FullyDevelopedFetch,
    .make = [](double wind_speed_10m, double fetch, const Cosine2sSpreading&) -> std::shared_ptr<const WaveSpectrum> {
      return std::make_shared<ElfouhailySpectrum>(wind_speed_10m, fetch);
    }};

}  // namespace albtpu
