// Shared by the mutators of fuzz targets.
#pragma once

#include <cstring>
#include <iterator>
#include <limits>
#include <random>
#include <string>

#include "tests/fuzz/fuzz_target.h"

// Mutates bytes: of libFuzzer, or of replay_main.cc.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace albtpu::fuzz {

template <typename Element, std::size_t count>
const Element& AnyOf(const Element (&elements)[count], std::mt19937& random) {
  return elements[random() % count];
}

// Zeros, usual nodes and limits of our axes, and numbers at which arithmetic fails; of either sign.
template <typename Number>
Number NotableNumber(std::mt19937& random) {
  using Limits = std::numeric_limits<Number>;
  constexpr Number kExtreme[] = {Limits::min(), Limits::denorm_min(), Limits::max(), Limits::infinity(),
                                 Limits::quiet_NaN()};
  constexpr Number kUsual[] = {0,     1e-7f, 1e-6f, 1e-3f, 0.1f, 0.25f, 0.4f, 1,   2,    3,     3.1416f, 7,    10,
                               12.5f, 20,    25,    45,    90,   91,    100,  150, 1000, 65536, 1e5f,    1e6f, 1e12f};
  const Number number = random() % 4 == 0 ? AnyOf(kExtreme, random) : AnyOf(kUsual, random);
  return random() % 4 == 0 ? -number : number;
}

// Puts `bytes` in the place of an input, or mutates the input byte by byte if there is no room for them.
inline std::size_t Replace(const std::string& bytes, std::uint8_t* data, std::size_t size, std::size_t max_size) {
  if (bytes.empty() || bytes.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, bytes.data(), bytes.size());
  return bytes.size();
}

}  // namespace albtpu::fuzz
