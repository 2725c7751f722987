// Sizes of grids that FFTW transforms fastest.
#pragma once

#include <cmath>

namespace albtpu {

// The least even size with no prime factor above 5.
inline int FastSize(double at_least) {
  for (int size = 2 * static_cast<int>(std::ceil(at_least / 2));; size += 2) {
    int rest = size;
    for (const int factor : {2, 3, 5}) {
      while (rest % factor == 0) rest /= factor;
    }
    if (rest == 1) return size;
  }
}

}  // namespace albtpu
