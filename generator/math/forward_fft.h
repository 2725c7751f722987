// Amplitudes of waves from real weights on a periodic square grid, by FFTW.
#pragma once

#include <Eigen/Core>

namespace albtpu {

// The sum of weights(ix, iy) exp(2 pi i (i ix + j iy) / size) for the waves j = 0, ..., size / 2 (columns) and all i
// (rows, in the order of SignedIndex): what a linear functional of heights makes of each wave of an InverseFft of the
// same size. `weights` is square, its side even. The other half is the mirror, the complex conjugate.
Eigen::MatrixXcd ForwardFft(const Eigen::MatrixXd& weights);

}  // namespace albtpu
