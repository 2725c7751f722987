// Blocks of pulses that are interpolated together, small enough for all of their data to stay in the first-level
// cache.
#pragma once

#include <cstddef>

namespace albtpu {

inline constexpr std::size_t kBlock = 256;

// A number for each pulse of a block.
template <typename Number>
struct alignas(64) BlockOf {
  Number number[kBlock];

  Number& operator[](std::size_t i) { return number[i]; }
  const Number& operator[](std::size_t i) const { return number[i]; }
  Number* begin() { return number; }
  const Number* begin() const { return number; }
};

}  // namespace albtpu
