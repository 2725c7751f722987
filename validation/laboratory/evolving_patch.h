// A patch of sea that evolves in time: random waves that travel by the dispersion of dispersion.h.
#pragma once

#include <complex>
#include <vector>

#include "generator/math/fft.h"
#include "generator/math/random_stream.h"
#include "sea/sea_state.h"

namespace albtpu {

// One realization of a periodic square patch. Immutable.
//
// The waves with the wavenumbers k and -k travel in opposite directions and are independent. With complex
// amplitudes a(k) of power 2 Psi(k) dkx dky, where Psi is directional, the elevation is the real part of the sum of
// a(k) exp(i (k . x - omega t)). At any instant this is a frozen surface with the spectrum SeaState::Psi.
class EvolvingPatch {
 public:
  // `length` [m] is that of a side, `size` the number of points along it, even. Modes at half the sampling wavenumber
  // are zero.
  EvolvingPatch(const SeaState& sea, double length, int size, const NormalStream& stream);

  // Elevations [m] at the points (ix, iy), iy varying fastest, `time` [s] after the start.
  std::vector<double> HeightsAt(double time) const;

 private:
  struct Mode {  // of the half plane of wavenumbers that is stored
    double angular_frequency;
    std::complex<double> forward, backward;  // half of a(k), and of the conjugate of a(-k)
  };

  InverseFft transform_;
  std::vector<Mode> modes_;
};

}  // namespace albtpu
