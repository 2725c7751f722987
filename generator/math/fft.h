// Fourier transforms of real functions on a periodic square grid, by FFTW in double precision.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>
#include <mutex>
#include <vector>

namespace albtpu {

// The smallest even size not below `at_least` that has no prime factor above 5: FFTW transforms such sizes fastest.
int FastSize(double at_least);

// The wavenumber of row `i` of the modes, in cycles along a side: 0, 1, ..., size / 2, ..., -2, -1.
inline int SignedIndex(int i, int size) { return i <= size / 2 ? i : i - size; }

// The mutex to hold while a plan is made or destroyed: FFTW's planner is not thread-safe, in either precision.
// Executing a plan is.
std::mutex& FftwPlanner();

// From the complex amplitudes of the modes to real heights. Immutable; one transform may run on many threads at once.
class InverseFft {
 public:
  explicit InverseFft(int size);  // points along a side, even
  ~InverseFft();
  InverseFft(InverseFft&&) noexcept;

  // Memory for the modes with the alignment that FFTW needs, uninitialized.
  struct Free {
    void operator()(std::complex<double>* memory) const;
  };
  using Modes = std::unique_ptr<std::complex<double>[], Free>;
  Modes Allocate() const;

  // Heights at the points (ix, iy), ix slow: the sum of mode(i, j) exp(2 pi i (i ix + j iy) / size) over all modes.
  // Mode (i, j) is `modes[row * (size / 2 + 1) + j]` with i = SignedIndex(row, size) and j from 0 to size / 2. The
  // modes with negative j follow from mode(-i, -j) = conj(mode(i, j)) and are not stored. The columns j = 0 and
  // j = size / 2 hold both members of each such pair, which the caller must make conjugate. Overwrites the modes.
  std::vector<double> operator()(Modes modes) const;

 private:
  struct Plan;
  int size_;
  std::unique_ptr<Plan> plan_;
};

// The sum of weights(ix, iy) exp(2 pi i (i ix + j iy) / size) over all points, for the modes j = 0, ..., size / 2
// (columns) and all i (rows, in the order of SignedIndex): the response of the linear functional `weights` of the
// heights to each mode of an InverseFft of the same size. The modes with negative j are the complex conjugates.
// `weights` is square, with an even side.
Eigen::MatrixXcd ForwardFft(const Eigen::MatrixXd& weights);

}  // namespace albtpu
