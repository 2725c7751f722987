#include "sea/files/directional_bins.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

namespace albtpu {
namespace {

// Of each direction, in the order given.
std::vector<double> Widths(const std::vector<double>& directions) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const std::size_t n = directions.size();
  const auto turned = [&](std::size_t i) {
    const double angle = std::fmod(directions[i], kTurn);
    return angle < 0 ? angle + kTurn : angle;
  };
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return turned(a) < turned(b); });
  std::vector<double> gaps(n);  // behind each, in order
  for (std::size_t i = 0; i + 1 < n; ++i) gaps[i] = turned(order[i + 1]) - turned(order[i]);
  gaps[n - 1] = turned(order[0]) + kTurn - turned(order[n - 1]);

  const double equal = kTurn / static_cast<double>(n);
  if (std::all_of(gaps.begin(), gaps.end(), [&](double gap) { return std::abs(gap - equal) < 0.1 * equal; }))
    return std::vector<double>(n, equal);

  std::vector<double> sorted = gaps;
  std::nth_element(sorted.begin(), sorted.begin() + n / 2, sorted.end());
  const double widest = 2 * sorted[n / 2];
  std::vector<double> widths(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double before = gaps[(i + n - 1) % n], behind = gaps[i];
    widths[order[i]] = 0.5 * ((before > widest ? behind : before) + (behind > widest ? before : behind));
  }
  return widths;
}

}  // namespace

DirectionalBins::DirectionalBins(std::vector<double> directions)
    : harmonics_(std::min(kSeaHarmonics, (directions.size() + 3) / 4 - 1)) {
  assert(directions.size() >= kFewest);
  std::array<double, kSeaHarmonics> ones;
  ones.fill(1);
  const std::vector<double> widths = Widths(directions);
  for (std::size_t i = 0; i < directions.size(); ++i)
    weights_.push_back(SymmetricEnergy(widths[i], ones, directions[i]));
}

DirectionalEnergy DirectionalBins::Sum(std::span<const double> densities) const {
  assert(densities.size() == weights_.size());
  DirectionalEnergy sum;
  for (std::size_t i = 0; i < densities.size(); ++i)
    if (densities[i] != 0) sum.Add(weights_[i], densities[i]);
  return sum;
}

}  // namespace albtpu
