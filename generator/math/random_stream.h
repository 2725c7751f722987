// Standard normal numbers that depend on nothing but (seed, cell, realization): the same on any thread, in
// any order.
#pragma once

#include <cstdint>
#include <span>

namespace albtpu {

// The counter-based generator Philox4x32-10 (Salmon et al. (2011), doi:10.1145/2063384.2063405) and Box and
// Muller.
class NormalStream {
 public:
  NormalStream(std::uint64_t seed, std::uint32_t cell, std::uint32_t realization, std::uint32_t part = 0)
      : seed_(seed), cell_(cell), realization_(realization), part_(part) {}

  // Another part of the same realization, from its beginning, independent of all others.
  NormalStream Part(std::uint32_t part) const { return {seed_, cell_, realization_, part}; }

  // Fills `normals` with independent numbers of mean 0 and variance 1. Each call goes on where the last one
  // ended, rounded up to four numbers.
  void Fill(std::span<double> normals);

  std::uint64_t seed() const { return seed_; }
  std::uint32_t cell() const { return cell_; }
  std::uint32_t realization() const { return realization_; }
  std::uint32_t part() const { return part_; }

 private:
  std::uint64_t seed_;
  std::uint32_t cell_, realization_, part_;
  std::uint32_t block_ = 0;
};

}  // namespace albtpu
