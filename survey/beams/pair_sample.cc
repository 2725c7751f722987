#include "survey/beams/pair_sample.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>
#include <utility>

namespace albtpu::client {
std::uint64_t HashOfTime(double time) {
  auto bits = std::bit_cast<std::uint64_t>(time) + 0x9E3779B97F4A7C15u;
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9u;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBu;
  return bits ^ (bits >> 31);
}

void PairSample::Add(const ReturnPair& pair) {
  ++seen_;
  pairs_.push_back(pair);
  if (pairs_.size() >= 2 * size_.pairs) Thin(size_.pairs);
}

std::vector<ReturnPair> PairSample::Take() {
  Thin(size_.pairs);
  const auto order = [](const ReturnPair& pair) {
    return std::tuple(pair.time, pair.lower.z(), pair.upper.z(), pair.lower.x(), pair.upper.x());
  };
  std::sort(pairs_.begin(), pairs_.end(),
            [&](const ReturnPair& a, const ReturnPair& b) { return order(a) < order(b); });
  return std::exchange(pairs_, {});
}

void PairSample::Thin(std::size_t most) {
  while (true) {
    const auto key = [this](const ReturnPair& pair) {
      return std::tuple(std::floor(pair.time / size_.bin), HashOfTime(pair.time), pair.lower.z(),
                        pair.upper.z());
    };
    std::sort(pairs_.begin(), pairs_.end(),
              [&](const ReturnPair& a, const ReturnPair& b) { return key(a) < key(b); });
    std::size_t kept = 0, in_bin = 0;
    double bin = 0;
    for (const ReturnPair& pair : pairs_) {
      const double own_bin = std::floor(pair.time / size_.bin);
      in_bin = kept > 0 && own_bin == bin ? in_bin + 1 : 0;
      bin = own_bin;
      if (in_bin < size_.pairs_per_bin) pairs_[kept++] = pair;
    }
    pairs_.resize(kept);
    if (kept <= most) return;
    if (size_.pairs_per_bin > 1) {
      size_.pairs_per_bin = (size_.pairs_per_bin + 1) / 2;
    } else {
      size_.bin *= 2;
    }
  }
}

}  // namespace albtpu::client
