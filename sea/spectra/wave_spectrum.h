// The interface of directional elevation spectra: Psi(kx, ky) = S(k) D(k, psi) / k [m^4].
#pragma once

#include <string>

namespace albtpu {

inline constexpr double kGravity = 9.80665;  // m/s^2, standard gravity, exact

struct WavenumberRange {
  double lowest, highest;  // rad/m
};

// Immutable. Wavenumbers are in rad/m and above 0.
class WaveSpectrum {
 public:
  virtual ~WaveSpectrum() = default;

  // S(k) [m^3]; its integral over k is the variance of elevation [m^2].
  virtual double operator()(double k) const = 0;

  // D [1/rad] of the waves that travel towards `psi` [rad] from downwind; its integral over a full turn is 1.
  virtual double Spreading(double k, double psi) const = 0;
  virtual bool spreading_varies_with_wavenumber() const = 0;

  virtual double peak_wavenumber() const = 0;

  // The wavenumbers between which all but 1e-4 of the elevation variance and of the slope variance lies.
  virtual WavenumberRange energetic_range() const = 0;

  // The attributes of a table: the name of the spectrum, its source, and its departures from measured seas.
  virtual std::string name() const = 0;
  virtual std::string reference() const = 0;
  virtual std::string departures() const = 0;
};

}  // namespace albtpu
