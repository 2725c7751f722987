// A directional spectrum over frequency, as instruments measure it and as a few numbers describe it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "sea/spectra/harmonic_spectrum.h"

namespace albtpu {

// E [m^2/Hz], and the integrals over directions of cos(2 n c) and sin(2 n c) times the directional density, where c is
// the compass direction [rad]. Waves from c and waves towards c have the same even harmonics.
struct DirectionalEnergy {
  double energy = 0;
  std::array<double, kSeaHarmonics> cosine{}, sine{};  // [n - 1]: harmonic 2 n

  DirectionalEnergy& Add(const DirectionalEnergy& other, double weight = 1);

  // Whether all directions have the same share, by the second harmonic.
  bool IsIsotropic() const;
  // The compass direction [rad] of the axis along which most of the energy travels, either way.
  double PrincipalAxis() const;
};

// The directional energy of `energy` [m^2/Hz] whose harmonics are `means` about the compass direction `axis` [rad].
DirectionalEnergy SymmetricEnergy(double energy, const std::array<double, kSeaHarmonics>& means, double axis);

// Immutable.
class FrequencySpectrum {
 public:
  virtual ~FrequencySpectrum() = default;

  virtual DirectionalEnergy operator()(double f) const = 0;  // f in Hz, above 0

  // What a sample at `f` stands for, if its neighbours are at `below` and `above`: the value at f unless the spectrum
  // changes within less than such a step.
  virtual DirectionalEnergy Between(double /*below*/, double f, double /*above*/) const { return (*this)(f); }

  // The peak [Hz] of the shortest waves that are described by a few numbers; absent where E is known by frequency.
  virtual std::optional<double> shortest_peak() const { return std::nullopt; }

  // Beyond it the spectrum is 0; infinity if it has no end.
  virtual double highest_frequency() const = 0;

  // The frequencies within [lowest, highest] by which the spectrum is compared with another one.
  virtual std::vector<double> ComparedFrequencies(double lowest, double highest) const = 0;

  // The frequency [Hz] up to which the waves are trusted. The tail begins there unless the description says otherwise.
  virtual double trusted_up_to() const = 0;

  virtual double significant_wave_height() const = 0;  // 4 sqrt(m0), m

  // The compass direction [rad] along which the first waves, or those at the peak, travel.
  virtual double leading_axis() const = 0;

  // The same for the shortest waves up to `f` [Hz]; none where they travel in all directions alike. A wind of unknown
  // direction is assumed to blow along it.
  virtual std::optional<double> ShortWaveAxis(double f) const = 0;
};

// S(k) and its harmonics in water of `depth` [m], with psi from the x axis, which points to the compass direction
// `x_azimuth` [rad]. Bins finer than the wavenumbers are averaged, so that the variance is kept.
HarmonicSpectrum ByWavenumber(const FrequencySpectrum& spectrum, double depth, double x_azimuth,
                              const std::vector<double>& wavenumbers);

}  // namespace albtpu
