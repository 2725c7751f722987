// The spectrum of a sea as a slanted beam sees it.
//
// On the water the footprint of a beam is an ellipse, longer by 1 / cos(incidence) along its azimuth. In the
// coordinates across the beam, x' = (cos(incidence) x along the azimuth, x across it), it is a circle. A wave of the
// wavenumber k has the wavenumber kappa there, k = (cos(incidence) kappa along, kappa across). In these coordinates
// all means over the footprint are integrals over one variable, wavenumber or lag.
#pragma once

#include <Eigen/Core>

#include "sea/quadrature/hankel_lattice.h"
#include "sea/spectra/harmonic_spectrum.h"

namespace albtpu {

// The harmonics of a spectrum about a beam: with P the elevation variance in d(ln kappa) d(psi), psi the direction from
// the azimuth across the beam, at the wavenumbers of the lattice
//     slope(i, m) = step kappa^2 integral over a turn of P exp(-2 i m psi) d(psi).
// The harmonic -m is the conjugate.
struct BeamSpectrum {
  double incidence;
  Eigen::MatrixXcd slope;  // wavenumber, harmonic

  int harmonics() const { return static_cast<int>(slope.cols()) - 1; }
};

// A sea on the wavenumbers of HankelLattice. Immutable.
class SlopeSpectrum {
 public:
  explicit SlopeSpectrum(const HarmonicSpectrum& spectrum);

  // Covariance of the slopes of all waves.
  Eigen::Matrix2d Covariance() const;

  BeamSpectrum AcrossBeam(double incidence, double azimuth) const;

 private:
  int harmonics_;
  Eigen::MatrixXd
      power_;  // step k^2 P(ln k, psi): the mean, then the factors of cos(2 n psi) and sin(2 n psi)
};

}  // namespace albtpu
