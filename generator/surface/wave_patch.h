// The short waves under a beam: a periodic square patch of sea on a regular grid, by inverse FFT of random
// amplitudes.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <functional>
#include <vector>

#include "generator/math/inverse_fft.h"
#include "generator/math/random_stream.h"
#include "generator/surface/cross_fade.h"
#include "sea/sea_state.h"

namespace albtpu {

// The spectrum of the patch on its lattice of wavenumbers. Immutable; draws from one model may run on many
// threads.
//
// Mode (i, j) has the wavenumber (2 pi / length) (i, j) and the expected power share(k) Psi dkx dky: what is
// not the patch's share is left to the long waves. Modes at half the sampling wavenumber are left empty. The
// variance of the heights is the sum of these powers, exactly.
class WavePatchModel {
 public:
  // `length` [m] above 0; `size` points along a side, even.
  WavePatchModel(const SeaState& sea, double length, int size, const CrossFade& share);

  double length() const { return length_; }
  int size() const { return size_; }
  double spacing() const { return length_ / size_; }
  // The expected |amplitude|^2 of mode (i, j), m^2; `row` stands for i = SignedIndex(row, size), j is from 0 to
  // size / 2.
  double power(int row, int j) const { return power_[static_cast<std::size_t>(row) * (size_ / 2 + 1) + j]; }

  // Elevations [m] at the points (ix, iy), ix slow: random Hermitian amplitudes through an FFT. A finer grid of
  // the same length draws the same amplitudes for the modes that both have.
  std::vector<double> Draw(const NormalStream& stream) const;

  // Each row of modes has a part of the stream to itself, whatever the size of the grid; part 0 is the long
  // waves'.
  static std::uint32_t PartOfRow(int i) { return i >= 0 ? 2 * i + 1 : -2 * i; }

  // The expectation of the product of two linear functionals of the heights as a function of what lies between
  // them, at all lags of the grid (as Draw gives heights), from what the product makes of each mode's power,
  // given the phase of the mode along one cell: a Hermitian function, factor(-x, -y) = conj(factor(x, y)).
  std::vector<double> Correlate(
      const std::function<std::complex<double>(double phase_x, double phase_y)>& factor) const;

  double elevation_variance() const;
  // Covariance of the slopes of the triangles of the grid, each mode weighted by `weight(k, psi)`. A triangle
  // sees the difference quotient of a wave, sin(kx dx / 2) / (dx / 2), not its slope kx.
  Eigen::Matrix2d FacetSlopeCovariance(const std::function<double(double k, double psi)>& weight) const;

 private:
  double length_;
  int size_;
  std::vector<double>
      power_;  // size x (size / 2 + 1), the expected |amplitude|^2; the other half is its mirror
  InverseFft transform_;
};

}  // namespace albtpu
