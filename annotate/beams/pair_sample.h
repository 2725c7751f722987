// Pairs of returns of a long file in bounded memory: a sample that is spread over its time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "budget/beams/return_pair.h"

namespace albtpu::annotate {

// A number that decides which pulses a sample keeps: equal for the returns of one pulse, and without order in time. The
// finalizer of SplitMix64 (Steele, Lea and Flood 2014, doi:10.1145/2714064.2660195).
std::uint64_t HashOfTime(double time);

struct PairSampleSize {
  double bin = 0.005;              // s; shorter than a turn of a scanner, so that all directions stay.
  std::size_t pairs_per_bin = 50;  // 10 000 pairs a second.
  std::size_t pairs = 1 << 19;     // Of all bins, 32 MB; while pairs are added, up to twice as many.
};

// A bin with more pairs keeps those whose times come first in the order of a hash, so that the pairs of one pulse stay
// together and the sample depends on the pairs alone, not on their order. When there are too many in all, bins keep
// fewer, and after that become wider.
class PairSample {
 public:
  explicit PairSample(const PairSampleSize& size = {}) : size_(size) {}

  // Requires finite numbers.
  void Add(const ReturnPair& pair);

  // The sample, in order of time.
  std::vector<ReturnPair> Take();

  std::uint64_t seen() const { return seen_; }

 private:
  void Thin(std::size_t most);

  PairSampleSize size_;
  std::vector<ReturnPair> pairs_;
  std::uint64_t seen_ = 0;
};

}  // namespace albtpu::annotate
