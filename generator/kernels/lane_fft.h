// The plan of inverse complex Fourier transforms of eight series at once, one in each lane of a vector. FFTW takes
// twice as long. lane_fft-inl.h executes the plan.
#pragma once

#include <cstddef>
#include <vector>

namespace albtpu {

// A mixed-radix decimation in time in place (Cooley and Tukey (1965), doi:10.1090/S0025-5718-1965-0178586-1). Each pass
// combines transforms into transforms `radix` times as long, beginning with single elements. Immutable.
class LaneFft {
 public:
  // An element holds the real parts of eight series, followed by their imaginary parts.
  static constexpr std::size_t kSeries = 8;
  static constexpr std::size_t kElement = 2 * kSeries;  // floats

  explicit LaneFft(int size);  // at least 2, with no prime factor above 5

  int size() const { return size_; }
  // The position in memory of element `i` of the input.
  int Place(int i) const { return place_[i]; }

  struct Pass {
    int radix;
    int length;  // of the transforms that it combines
    // exp(2 pi i q k / (radix length)), real and imaginary part, q from 1 to radix - 1 (fast), k from 0 to length - 1
    // (slow).
    std::vector<float> twiddles;
  };
  const std::vector<Pass>& passes() const { return passes_; }

 private:
  int size_;
  std::vector<Pass> passes_;
  std::vector<int> place_;
};

}  // namespace albtpu
