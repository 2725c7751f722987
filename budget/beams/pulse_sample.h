// Samples of returns in bounded memory: pairs that are spread over the time of a long file, and returns of one pulse
// that lie far apart, as in a file that is sorted by place, found by their times.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "budget/beams/return_pair.h"

namespace albtpu {

// A number that decides which pulses a sample keeps: equal for the returns of one pulse, and without order in time. The
// finalizer of SplitMix64 (Steele, Lea and Flood 2014, doi:10.1145/2714064.2660195).
std::uint64_t HashOfTime(double time);

struct PairSampleSize {
  double bin = 0.005;              // s; shorter than a turn of a scanner, so that all directions stay.
  std::size_t pairs_per_bin = 50;  // 10 000 pairs a second.
  std::size_t pairs = 1 << 19;     // Of all bins, 32 MB; while pairs are added, up to twice as many.
};

// Pairs of returns of a long file in bounded memory: a sample that is spread over its time.
//
// A bin with more pairs keeps those whose times come first in the order of a hash, so that the pairs of one pulse stay
// together and the sample depends on the pairs alone, not on their order. When there are too many in all, bins keep
// fewer, and after that become wider.
class PairSample {
 public:
  explicit PairSample(const PairSampleSize& size = {}) : size_(size) {}

  // Requires finite numbers.
  void Add(const ReturnPair& pair);

  // Drops pairs that no sample of this size would keep, whatever is added to it. Merging is faster after it.
  void Prune() { Thin(std::numeric_limits<std::size_t>::max()); }

  // `other` must be of the same size.
  void Merge(const PairSample& other);

  void Clear();

  // The sample, in order of time.
  std::vector<ReturnPair> Take();

  std::uint64_t seen() const { return seen_; }

 private:
  void Thin(std::size_t most);

  PairSampleSize size_;
  PairSampleSize now_ = size_;  // What a bin keeps, and how wide it is, so far.
  std::vector<ReturnPair> pairs_;
  std::uint64_t seen_ = 0;
};

struct PulseReturn {
  std::uint64_t record = 0;  // Its number in the file.
  double time = 0;           // GPS time as the file states it.
  Eigen::Vector3d position;  // m, in the local frame.
  std::uint8_t number = 0, count = 0,
               channel = 0;  // Of the return, of the returns of its pulse, of the scanner.
  bool chosen = false;       // Of a chosen class.
};

// When there are too many returns, those of a random half of the pulses stay: the ones whose times have the smaller
// hashes. So all returns of a pulse stay or none, wherever they lie, and the sample depends on neither their order nor
// how they were divided.
class PulseSample {
 public:
  // Keeps at most `most` returns; while they are added, up to twice as many of 56 bytes.
  explicit PulseSample(std::size_t most = 1 << 19) : most_(most) {}

  void Add(const PulseReturn& pulse_return);

  // The returns of each pulse, side by side. Pulses of one return are left out, and those of equal times and channels
  // that cannot be separated: more returns than one pulse has, or two of one number.
  std::vector<std::vector<PulseReturn>> Take();

 private:
  void Thin();

  std::size_t most_;
  std::uint64_t limit_ = std::numeric_limits<std::uint64_t>::max();  // Upper bound of the hashes that stay.
  std::vector<PulseReturn> returns_;
};

}  // namespace albtpu
