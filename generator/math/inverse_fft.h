// Real heights on a periodic square grid from the amplitudes of its waves, by FFTW.
#pragma once

#include <complex>
#include <memory>
#include <vector>

namespace albtpu {

// Immutable; one transform may run on many threads.
class InverseFft {
 public:
  explicit InverseFft(int size);  // points along a side, even
  ~InverseFft();
  InverseFft(InverseFft&&) noexcept;

  // Memory aligned as FFTW wants it, not initialized.
  struct Free {
    void operator()(std::complex<double>* memory) const;
  };
  using Modes = std::unique_ptr<std::complex<double>[], Free>;
  Modes Allocate() const;

  // Heights at the points (ix, iy), ix slow: the sum of modes times exp(2 pi i (i ix + j iy) / size). Mode
  // (i, j) is `modes[row * (size / 2 + 1) + j]` with i = SignedIndex(row, size) and j from 0 to size / 2;
  // the other half is its mirror, conj(mode(-i, -j)). Of the columns j = 0 and j = size / 2 both halves are
  // stored, and must be mirrors already. The transform overwrites the modes.
  std::vector<double> operator()(Modes modes) const;

 private:
  struct Plan;
  int size_;
  std::unique_ptr<Plan> plan_;
};

// The wave that row `i` of the modes stands for, in turns along the side: 0, 1, ..., size / 2, ..., -2, -1.
inline int SignedIndex(int i, int size) { return i <= size / 2 ? i : i - size; }

}  // namespace albtpu
