#include "sea/correlation/pairs_in_cell.h"

#include <algorithm>

namespace albtpu {

void PairsInCell::Add(double x, double y) {
  const auto step = [](double at) { return std::clamp(static_cast<int>(kParts * at), 0, kParts - 1); };
  ++counts_[static_cast<std::size_t>(step(y) * kParts + step(x))];
}

std::array<double, kCellLevels> PairsInCell::Weights() const {
  double pulses = 0;
  std::array<double, kCellLevels + 1> together =
      {};  // Ordered pairs that share a part of this level, or are one pulse.
  for (int level = 0; level < kCellLevels; ++level) {
    std::array<double, kParts* kParts> parts = {};
    const int shift = kCellLevels - 1 - level;
    for (int y = 0; y < kParts; ++y)
      for (int x = 0; x < kParts; ++x)
        parts[static_cast<std::size_t>((y >> shift) * kParts + (x >> shift))] +=
            counts_[static_cast<std::size_t>(y * kParts + x)];
    for (const double count : parts) together[static_cast<std::size_t>(level)] += count * count;
  }
  for (const double count : counts_) pulses += count;
  together.back() = pulses;
  std::array<double, kCellLevels> weights = {};
  for (std::size_t level = 0; level < weights.size(); ++level) {
    const double apart = together[level] - together[level + 1];  // In different quarters.
    if (level + 1 == weights.size()) {
      weights[level] += apart;
    } else {
      weights[level] += 4 * apart / 3, weights[level + 1] -= apart / 3;
    }
  }
  return weights;
}

}  // namespace albtpu
