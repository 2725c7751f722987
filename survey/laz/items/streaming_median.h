// The median of the recent numbers of a sequence, approximately and without a search.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace albtpu::laz {

// Keeps five numbers in order. Each new one takes the place of the largest or the smallest in turn: of the largest as
// long as new numbers are below the median, then of the smallest as long as they are above it.
class StreamingMedian {
 public:
  std::int32_t median() const { return sorted_[2]; }

  void Add(std::int32_t number) {
    const std::int32_t* const kept = &sorted_[replaces_smallest_];
    const std::array<std::int32_t, 4> four = {kept[0], kept[1], kept[2], kept[3]};
    // No branches: whether a number is above the median is hard to predict.
    const unsigned above = number > median(), equal = number == median();
    replaces_smallest_ = above | (equal & (replaces_smallest_ ^ 1u));
    sorted_[0] = std::min(four[0], number);
    sorted_[1] = std::max(four[0], std::min(four[1], number));
    sorted_[2] = std::max(four[1], std::min(four[2], number));
    sorted_[3] = std::max(four[2], std::min(four[3], number));
    sorted_[4] = std::max(four[3], number);
  }

 private:
  std::array<std::int32_t, 5> sorted_{};
  unsigned replaces_smallest_ = 0;  // 0 or 1.
};

}  // namespace albtpu::laz
