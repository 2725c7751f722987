// A histogram of lengths in equal steps.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace albtpu::quality {

struct LengthHistogram {
  static constexpr std::size_t kSteps = 1000;  // The last has all that is greater.

  double step;  // m
  std::vector<std::uint64_t> counts = std::vector<std::uint64_t>(kSteps);

  void Add(double value) { ++counts[std::min(static_cast<std::size_t>(value / step), kSteps - 1)]; }
  // step, and counts up to the last that is not 0.
  nlohmann::ordered_json ToJson() const;
};

}  // namespace albtpu::quality
