// The short waves under a beam: a periodic square patch of sea on a regular grid, by inverse FFT of random
// amplitudes.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "generator/math/fft.h"
#include "generator/math/random_stream.h"
#include "sea/sea_state.h"

namespace albtpu {

// The fraction of the waves' power at wavenumber k that the patch holds; the rest belongs to the plane waves of
// LongWaveModel (sea_surface.h). The fraction is 0 for waves longer than `all_long` and 1 for waves shorter than
// `all_patch`, with a smooth transition in the logarithm of the wavenumber. A sharp cut would fall through the cells of
// the patch's lattice of wavenumbers.
class CrossFade {
 public:
  CrossFade(double all_long, double all_patch) : all_long_(all_long), all_patch_(all_patch) {}  // rad/m, increasing

  double operator()(double k) const {
    const double t = std::clamp(std::log(k / all_long_) / std::log(all_patch_ / all_long_), 0.0, 1.0);
    return 0.5 - 0.5 * std::cos(std::numbers::pi * t);
  }
  double all_patch() const { return all_patch_; }

 private:
  double all_long_, all_patch_;
};

// The spectrum of the patch on its lattice of wavenumbers. Immutable; one model may draw on many threads at once.
//
// Mode (i, j) has the wavenumber (2 pi / length) (i, j) and the expected power share(k) Psi dkx dky, raised by the
// deficit of the slope of the grid's triangles: where a wave spans only a few points, it is drawn higher, so that the
// triangles have its mean square slope. Modes at half the sampling wavenumber are empty. The variance of the heights is
// exactly the sum of these powers.
class WavePatchModel {
 public:
  // `length` [m] above 0; `size` points along a side, even.
  WavePatchModel(const SeaState& sea, double length, int size, const CrossFade& share);

  double length() const { return length_; }
  int size() const { return size_; }
  double spacing() const { return length_ / size_; }
  // The expected |amplitude|^2 of mode (i, j), m^2, with i = SignedIndex(row, size) and j from 0 to size / 2.
  double power(int row, int j) const { return power_[static_cast<std::size_t>(row) * (size_ / 2 + 1) + j]; }

  // Elevations [m] at the points (ix, iy), ix slow, by an inverse FFT of random Hermitian amplitudes. A finer grid of
  // the same length draws the same amplitudes for the modes that both grids have.
  std::vector<double> Draw(const NormalStream& stream) const;

  // The part of the stream from which the modes of row i are drawn, whatever the size of the grid. Part 0 belongs to
  // the long waves.
  static std::uint32_t PartOfRow(int i) { return i >= 0 ? 2 * i + 1 : -2 * i; }

  // The covariance of two linear functionals of the heights as a function of the lag between them, at all lags of the
  // grid (in the layout of Draw). `factor(phase_x, phase_y)` is the product of the first functional's response to a
  // mode of unit amplitude and the conjugate of the second's, given the phases of the mode across one cell. It must be
  // Hermitian: factor(-x, -y) = conj(factor(x, y)).
  std::vector<double> Correlate(
      const std::function<std::complex<double>(double phase_x, double phase_y)>& factor) const;

  double elevation_variance() const;
  // Covariance of the slopes of the grid's triangles, with each mode weighted by `weight(k, psi)`. A triangle has the
  // difference quotient of a wave, sin(kx dx / 2) / (dx / 2), and not its slope kx.
  Eigen::Matrix2d FacetSlopeCovariance(const std::function<double(double k, double psi)>& weight) const;

 private:
  double length_;
  int size_;
  std::vector<double> power_;  // of the stored half of the modes, size x (size / 2 + 1)
  InverseFft transform_;
};

}  // namespace albtpu
