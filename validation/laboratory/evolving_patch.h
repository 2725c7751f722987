// A patch of sea that evolves in time: random waves, each travelling by the dispersion of dispersion.h.
#pragma once

#include <complex>
#include <vector>

#include "generator/math/inverse_fft.h"
#include "generator/math/random_stream.h"
#include "sea/sea_state.h"

namespace albtpu {

// One realization of a periodic square patch. Immutable.
//
// The waves with the wavenumbers k and -k travel in opposite directions and are independent; with complex
// amplitudes a(k) of power 2 Psi(k) dkx dky, Psi directional, the elevation is the real part of the sum of
// a(k) exp(i (k . x - omega t)). At any instant that is a frozen surface with the spectrum SeaState::Psi.
class EvolvingPatch {
 public:
  // `length` [m] of a side, `size` points along it, even. Modes at half the sampling wavenumber stay empty.
  EvolvingPatch(const SeaState& sea, double length, int size, const NormalStream& stream);

  // Elevations [m] at the points (ix, iy), ix slow, `time` [s] after the beginning.
  std::vector<double> HeightsAt(double time) const;

 private:
  struct Mode {  // of the half plane that an InverseFft stores
    double angular_frequency;
    std::complex<double> forth, back;  // half of a(k), and of the conjugate of a(-k)
  };

  InverseFft transform_;
  std::vector<Mode> modes_;
};

}  // namespace albtpu
