// What a directional elevation spectrum of wind waves is: Psi(kx, ky) = S(k) D(k, psi) / k [m^4].
#pragma once

namespace albtpu {

inline constexpr double kGravity = 9.80665;  // m/s^2, standard gravity, exact

// Of inverse wave age (wind speed over the phase speed at the peak) in the fully developed sea; Elfouhaily et
// al. (1997), doi:10.1029/97JC00467, and Birkebak et al. (2018), Eq. 7.
inline constexpr double kFullyDevelopedOmega = 0.84;

struct WavenumberRange {
  double lowest, highest;  // rad/m
};

// Immutable. Wavenumbers in rad/m, above 0.
class WaveSpectrum {
 public:
  virtual ~WaveSpectrum() = default;

  // S(k) [m^3]; its integral over k is the variance of elevation [m^2].
  virtual double operator()(double k) const = 0;

  // D [1/rad] of the waves that travel at `psi` [rad] from downwind; its integral over a full turn is 1.
  virtual double Spreading(double k, double psi) const = 0;
  virtual bool spreading_varies_with_wavenumber() const = 0;

  virtual double peak_wavenumber() const = 0;
  virtual double inverse_wave_age() const = 0;

  // Wavenumbers between which all but 1e-4 of the elevation and of the slope variance lies.
  virtual WavenumberRange energetic_range() const = 0;
};

}  // namespace albtpu
