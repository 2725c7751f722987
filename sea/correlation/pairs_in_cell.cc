#include "sea/correlation/pairs_in_cell.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace albtpu {

Eigen::Vector2d SquareOfCircle(const Eigen::Vector2d& at) {
  const double radius = std::min(at.norm(), 1.0);
  // Rings become squares: each quarter of a ring, about one axis, a side.
  const auto side = [radius](double about, double along) {
    const double sign = std::copysign(1, about), part = std::atan2(along, std::abs(about)) * 4 / std::numbers::pi;
    return std::pair(0.5 + sign * radius / 2, 0.5 + part * radius / 2);
  };
  if (std::abs(at.x()) >= std::abs(at.y())) {
    const auto [x, y] = side(at.x(), at.y());
    return {x, y};
  }
  const auto [y, x] = side(at.y(), at.x());
  return {x, y};
}

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
