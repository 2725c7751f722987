// The median of the recent numbers of a sequence, approximately and without a search.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

namespace albtpu::laz {

// Keeps five numbers in order. Each new one takes the place of the largest or the smallest in turn: of the largest as
// long as new numbers are below the median, then of the smallest as long as they are above it.
class StreamingMedian {
 public:
  std::int32_t median() const { return sorted_[2]; }

  void Add(std::int32_t number) {
    // Four numbers at a time and no branches: where a number belongs is hard to predict.
    const std::int32_t* const first_kept = &sorted_[replaces_smallest_];
    const std::int32_t greatest = first_kept[3];
    const Four kept = {first_kept[0], first_kept[1], first_kept[2], greatest};
    const Four numbers = {number, number, number, number};
    const Four below = kept < numbers ? kept : numbers;
    const Four next_below = {below[0], kept[0], kept[1], kept[2]};
    const Four sorted = below > next_below ? below : next_below;
    const unsigned above = number > median(), equal = number == median();
    replaces_smallest_ = above | (equal & (replaces_smallest_ ^ 1u));
    std::memcpy(sorted_.data(), &sorted, sizeof sorted);
    sorted_[4] = number > greatest ? number : greatest;
  }

 private:
  using Four [[gnu::vector_size(16)]] = std::int32_t;

  std::array<std::int32_t, 5> sorted_{};
  unsigned replaces_smallest_ = 0;  // 0 or 1.
};

}  // namespace albtpu::laz
