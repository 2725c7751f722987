// The plan of an inverse complex transform of eight series side by side, one in each lane of a vector.
//
// FFTW takes twice as long for them. lane_fft-inl.h runs it.
#pragma once

#include <cstddef>
#include <vector>

namespace albtpu {

// A decimation in time in place (Cooley and Tukey (1965), doi:10.1090/S0025-5718-1965-0178586-1), of mixed
// radix: each pass makes transforms `radix` times as long, the first one of single elements. Immutable.
class LaneFft {
 public:
  // Elements lie side by side: the real part of eight series, and their imaginary part.
  static constexpr std::size_t kSeries = 8;
  static constexpr std::size_t kElement = 2 * kSeries;  // floats

  explicit LaneFft(int size);  // at least 2, with no prime factor above 5

  int size() const { return size_; }
  // Where the element `i` of the input has to lie.
  int Place(int i) const { return place_[i]; }

  struct Pass {
    int radix;
    int length;  // of the transforms that it takes
    // exp(2 pi i q k / (radix length)), real and imaginary part, q from 1 to radix - 1 fast, k from 0 to
    // length - 1.
    std::vector<float> twiddles;
  };
  const std::vector<Pass>& passes() const { return passes_; }

 private:
  int size_;
  std::vector<Pass> passes_;
  std::vector<int> place_;
};

}  // namespace albtpu
