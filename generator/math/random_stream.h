// Random numbers that are a function of (seed, cell, realization, part) alone: the same on any thread and in any order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace albtpu {

// Standard normal numbers: the counter-based generator Philox4x32-10 (Salmon et al. (2011),
// doi:10.1145/2063384.2063405) with the transform of Box and Muller.
class NormalStream {
 public:
  NormalStream(std::uint64_t seed, std::uint32_t cell, std::uint32_t realization, std::uint32_t part = 0)
      : seed_(seed), cell_(cell), realization_(realization), part_(part) {}

  // Another part of the same realization, from its beginning. Parts are independent of each other.
  NormalStream Part(std::uint32_t part) const { return {seed_, cell_, realization_, part}; }

  // Fills `normals` with independent numbers of mean 0 and variance 1. Each call continues where the previous one
  // ended, rounded up to a multiple of four numbers.
  void Fill(std::span<double> normals);

  std::uint64_t seed() const { return seed_; }
  std::uint32_t cell() const { return cell_; }
  std::uint32_t realization() const { return realization_; }
  std::uint32_t part() const { return part_; }

 private:
  std::uint64_t seed_;
  std::uint32_t cell_, realization_, part_;
  std::uint32_t block_ = 0;  // of four numbers
};

// Uniform numbers in (0, 1), multiples of 2^-32 and a half, by the same generator.
class UniformStream {
 public:
  UniformStream(std::uint64_t seed, std::uint32_t cell, std::uint32_t realization, std::uint32_t part = 0)
      : seed_(seed), cell_(cell), realization_(realization), part_(part) {}

  double Next() {
    if (used_ == words_.size()) Draw();
    return (words_[used_++] + 0.5) * 0x1p-32;
  }

 private:
  void Draw();

  std::uint64_t seed_;
  std::uint32_t cell_, realization_, part_;
  std::uint32_t block_ = 0;
  std::array<std::uint32_t, 4> words_;
  std::size_t used_ = words_.size();
};

// The instruction set on which this machine runs FFTW, the C library and the kernels.

// The microarchitecture level of the x86-64 psABI ("x86-64-v3"), or the name of another architecture. FFTW and the C
// library choose their code by it, so the last bit of a result depends on it.
std::string InstructionSet();

}  // namespace albtpu
