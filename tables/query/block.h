// Blocks of pulses that are interpolated at a time: few enough for their data to stay in the nearest caches. For all
// values and standard errors of the sea surface, a block touches 25 KiB of PulseBlock and BlockValues, or 38 KiB if the
// azimuth is absent. The rest of BlockValues is for kinds of tables that have more sets of records.
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
