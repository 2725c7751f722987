#include "generator/kernels/lane_fft.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace albtpu {

LaneFft::LaneFft(int size) : size_(size), place_(size) {
  assert(size >= 2);
  int length = 1;
  for (const int radix : {5, 3, 8, 4, 2}) {
    for (; size / length % radix == 0; length *= radix) {
      Pass pass = {radix, length, {}};
      for (int k = 0; k < length; ++k) {
        for (int q = 1; q < radix; ++q) {
          const double angle = 2 * std::numbers::pi * q * k / (radix * length);
          pass.twiddles.push_back(static_cast<float>(std::cos(angle)));
          pass.twiddles.push_back(static_cast<float>(std::sin(angle)));
        }
      }
      passes_.push_back(std::move(pass));
    }
  }
  assert(length == size);

  // The last pass combines `radix` transforms, of which transform q holds the elements i = q, q + radix, ...; each of
  // these comes from the pass before in the same way.
  for (int i = 0; i < size; ++i) {
    int rest = i;
    for (auto pass = passes_.rbegin(); pass != passes_.rend(); ++pass) {
      place_[i] += rest % pass->radix * pass->length;
      rest /= pass->radix;
    }
  }
}

}  // namespace albtpu
