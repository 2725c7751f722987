// Covariances of the water's slopes and heights between two points, by the vector between them.
#pragma once

#include <Eigen/Core>

#include "sea/response/beam_spectrum.h"

namespace albtpu {

// In the coordinates across a beam, at the lags 0, FootprintKernel::kLagStride, ... of the lattice. Harmonics l in the
// direction beta of the lag: a function is the sum over all l of its harmonic times exp(2 i l beta).
//
// Derivation: with P and its harmonics e_m as in BeamSpectrum, the integral of P cos(kappa s cos(psi - beta)) d(psi) is
// the sum over m of (-1)^m e_m J_2m(kappa s) exp(2 i m beta).
struct LagCovariances {
  LagCovariances(const BeamSpectrum& spectrum, int lags);

  // R_xx + R_yy of the slopes: l from 0; the harmonic -l is the conjugate.
  Eigen::MatrixXcd trace;
  // R_xx - R_yy + 2 i R_xy: l from 0, and -l from 0.
  Eigen::MatrixXcd difference, difference_of_negative;
  // Half the mean square of the difference of two heights, m^2: the variance less the covariance of heights.
  Eigen::MatrixXcd height;
};

// Means over all directions of the lag of products of the elements R of the slopes' covariance, one row per lag:
// |T|^2, |Z|^2, Re T Z, Im T Z, Re Z Z, Im Z Z, with T the trace and Z the difference above.
using LagProducts = Eigen::Matrix<double, Eigen::Dynamic, 6>;
LagProducts ProductsOf(const LagCovariances& covariances);

}  // namespace albtpu
