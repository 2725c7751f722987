// The unified spectrum of long and short wind waves of Elfouhaily et al.
#pragma once

#include "sea/spectra/jonswap_peak.h"
#include "sea/spectra/wave_spectrum.h"

namespace albtpu {

// S(k) = k^-3 (B_l + B_h): curvature spectra of long waves after JONSWAP and of short ones after the slopes
// of Cox and Munk (1954), with a spreading of its own, alike for waves with and against the wind.
//
// Source: Elfouhaily, Chapron, Katsaros and Vandemark (1997), doi:10.1029/97JC00467; equation numbers are
// theirs. The friction velocity is that of wind_profile.h, Wu's, as is usual with this spectrum since
// McDaniel (2001), Waves in Random Media 11, 343-360.
//
// Below a wind of some 2.75 m/s Eq. 44 would make the short waves' curvature negative: there are none.
class ElfouhailySpectrum final : public WaveSpectrum {
 public:
  // `fetch` in m, above 0; infinity means fully developed. Requires wind_speed_10m > 0 [m/s].
  ElfouhailySpectrum(double wind_speed_10m, double fetch);

  double operator()(double k) const override;             // Eq. 30
  double Spreading(double k, double psi) const override;  // Eq. 49
  bool spreading_varies_with_wavenumber() const override { return true; }
  double peak_wavenumber() const override { return k_p_; }
  double inverse_wave_age() const override { return omega_; }  // Eq. 37
  WavenumberRange energetic_range() const override;

  // (D along - D across) / (D along + D across) of the waves of wavenumber `k`: Eq. 57.
  double Delta(double k) const;

  double friction_velocity() const { return friction_velocity_; }  // m/s

  // Eq. 37.
  static double InverseWaveAge(double wind_speed_10m, double fetch);

  // The fetch [m] beyond which the sea is taken as fully developed: Eq. 37 gets there only in the limit, here
  // Omega is within 1 % of 0.84.
  static double FullyDevelopedFetch(double wind_speed_10m);

 private:
  double omega_, k_p_, c_p_, alpha_p_;
  JonswapPeak peak_;
  double friction_velocity_, alpha_m_;
};

}  // namespace albtpu
