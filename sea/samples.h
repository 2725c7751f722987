// Samples of many numbers: their median, and the hash by which a part of them is drawn.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace albtpu {

// The middle one of `values`, which are at least one; of an even number the upper one of the two in the middle.
inline double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Whether an element is drawn is a function of its key alone, never of the order in which elements come: the keys with
// the lowest hashes stay. Every bit of a key changes half of the bits of its hash.
//
// The finalizer of SplitMix64: Steele, Lea and Flood (2014), doi:10.1145/2660193.2660195.
constexpr std::uint64_t MixBits(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
  return bits ^ (bits >> 31);
}

}  // namespace albtpu
