// A sea without waves.
#pragma once

#include <numbers>

#include "sea/spectra/wave_spectrum.h"

namespace albtpu {

// S(k) = 0. Wavenumbers and directions have no meaning; they are such that every computation with them is defined.
class CalmSpectrum final : public WaveSpectrum {
 public:
  double operator()(double) const override { return 0; }
  double Spreading(double, double) const override { return 1 / (2 * std::numbers::pi); }
  bool spreading_varies_with_wavenumber() const override { return false; }
  double peak_wavenumber() const override { return 1; }
  WavenumberRange energetic_range() const override { return {1, 1000}; }
  std::string name() const override { return "no waves"; }
  std::string reference() const override { return "none: a calm"; }
  std::string departures() const override { return "A calm has no waves; measured seas keep their swell."; }
};

}  // namespace albtpu
