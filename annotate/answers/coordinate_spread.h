// The minimum, the maximum and the approximate median of many numbers, in one pass and in little memory.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace albtpu::annotate {

// Does not depend on the order of the numbers, nor on the order of merging.
class CoordinateSpread {
 public:
  void Add(float value);  // Finite.
  void Merge(const CoordinateSpread& other);

  std::uint64_t count() const { return count_; }
  // Of at least one number.
  float least() const { return least_; }
  float greatest() const { return greatest_; }
  // The median to 1/16 of itself; exactly, where all numbers are the same.
  float middle() const;

 private:
  std::uint64_t count_ = 0;
  float least_ = std::numeric_limits<float>::infinity(), greatest_ = -least_;
  std::vector<std::uint64_t> bins_;  // Empty until the first number.
};

}  // namespace albtpu::annotate
