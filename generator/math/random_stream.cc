#include "generator/math/random_stream.h"

#include <Random123/philox.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

// From two uniform words to two normals. The added half keeps the logarithm finite; the largest normal is 6.8.
void BoxMuller(std::uint32_t u, std::uint32_t v, double* normals) {
  const double radius = std::sqrt(-2 * std::log((u + 0.5) * 0x1p-32));
  const double angle = 2 * std::numbers::pi * (v * 0x1p-32);
  normals[0] = radius * std::cos(angle);
  normals[1] = radius * std::sin(angle);
}

r123::Philox4x32::key_type KeyOf(std::uint64_t seed) {
  return {{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}};
}

}  // namespace

void NormalStream::Fill(std::span<double> normals) {
  const r123::Philox4x32::key_type key = KeyOf(seed_);
  for (std::size_t i = 0; i < normals.size(); i += 4) {
    const r123::Philox4x32::ctr_type counter = {{block_++, realization_, cell_, part_}};
    const r123::Philox4x32::ctr_type words = r123::Philox4x32()(counter, key);
    std::array<double, 4> four;
    BoxMuller(words[0], words[1], &four[0]);
    BoxMuller(words[2], words[3], &four[2]);
    std::copy_n(four.begin(), std::min<std::size_t>(4, normals.size() - i), normals.begin() + i);
  }
}

void UniformStream::Draw() {
  const r123::Philox4x32::ctr_type words = r123::Philox4x32()({{block_++, realization_, cell_, part_}}, KeyOf(seed_));
  std::copy(words.begin(), words.end(), words_.begin());
  used_ = 0;
}

std::string InstructionSet() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl")) return "x86-64-v4";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "x86-64-v3";
  return "x86-64";
#elif defined(__aarch64__)
  return "aarch64";
#else
  return "unknown";
#endif
}

}  // namespace albtpu
