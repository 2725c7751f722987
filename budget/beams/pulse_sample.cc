#include "budget/beams/pulse_sample.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>
#include <utility>

#include "sea/samples.h"

namespace albtpu {
namespace {

auto PlaceOf(const ReturnPair& pair) {
  return std::tuple(pair.lower.z(), pair.upper.z(), pair.lower.x(), pair.upper.x(), pair.lower.y(), pair.upper.y());
}

}  // namespace

std::uint64_t HashOfTime(double time) { return MixBits(std::bit_cast<std::uint64_t>(time) + 0x9e3779b97f4a7c15); }

void PairSample::Add(const ReturnPair& pair) {
  ++seen_;
  pairs_.push_back(pair);
  if (pairs_.size() >= 2 * size_.pairs) Thin(size_.pairs);
}

void PairSample::Merge(const PairSample& other) {
  seen_ += other.seen_;
  const std::size_t size = pairs_.size() + other.pairs_.size();
  if (size >= 2 * size_.pairs) Thin(size_.pairs);
  // Growing step by step would copy all pairs, and meanwhile hold them twice.
  if (size > size_.pairs / 8) pairs_.reserve(2 * size_.pairs);
  pairs_.insert(pairs_.end(), other.pairs_.begin(), other.pairs_.end());
}

void PairSample::Clear() {
  pairs_.clear();
  seen_ = 0;
  now_ = size_;
}

std::vector<ReturnPair> PairSample::Take() {
  Thin(size_.pairs);
  const auto order = [](const ReturnPair& pair) { return std::tuple_cat(std::tuple(pair.time), PlaceOf(pair)); };
  const auto is_before = [&](const ReturnPair& a, const ReturnPair& b) { return order(a) < order(b); };
  if (!std::is_sorted(pairs_.begin(), pairs_.end(), is_before)) std::sort(pairs_.begin(), pairs_.end(), is_before);
  return std::exchange(pairs_, {});
}

void PairSample::Thin(std::size_t most) {
  // Sorted in place of the pairs, which are three times as long.
  struct Rank {
    double bin;
    std::uint64_t hash;
    std::size_t pair;
  };
  const auto is_before_in_bin = [this](const Rank& a, const Rank& b) {
    if (a.hash != b.hash) return a.hash < b.hash;
    const ReturnPair &first = pairs_[a.pair], &second = pairs_[b.pair];
    return PlaceOf(first) < PlaceOf(second);
  };
  const auto is_of_earlier_bin = [](const Rank& a, const Rank& b) { return a.bin < b.bin; };
  std::vector<Rank> ranks(pairs_.size());
  for (std::size_t i = 0; i < ranks.size(); ++i) ranks[i].hash = HashOfTime(pairs_[i].time), ranks[i].pair = i;
  std::vector<std::size_t> ends;  // Where each bin ends in `ranks`.
  const auto sort_into_bins = [&] {
    for (Rank& rank : ranks) rank.bin = std::floor(pairs_[rank.pair].time / now_.bin);
    // Most files are in order of time.
    if (!std::is_sorted(ranks.begin(), ranks.end(), is_of_earlier_bin))
      std::sort(ranks.begin(), ranks.end(), is_of_earlier_bin);
    ends.clear();
    for (std::size_t i = 1; i < ranks.size(); ++i)
      if (ranks[i].bin != ranks[i - 1].bin) ends.push_back(i);
    if (!ranks.empty()) ends.push_back(ranks.size());
  };
  const auto kept = [&] {
    std::size_t count = 0, begin = 0;
    for (const std::size_t end : ends) count += std::min(end - begin, now_.pairs_per_bin), begin = end;
    return count;
  };
  sort_into_bins();
  while (kept() > most) {
    if (now_.pairs_per_bin > 1) {
      now_.pairs_per_bin = (now_.pairs_per_bin + 1) / 2;
    } else {
      now_.bin *= 2;
      sort_into_bins();
    }
  }
  std::vector<bool> is_kept(pairs_.size());
  auto first = ranks.begin();
  for (const std::size_t end : ends) {
    const auto last = ranks.begin() + static_cast<std::ptrdiff_t>(end);
    auto dropped = last;
    if (last - first > static_cast<std::ptrdiff_t>(now_.pairs_per_bin)) {
      dropped = first + static_cast<std::ptrdiff_t>(now_.pairs_per_bin);
      std::nth_element(first, dropped, last, is_before_in_bin);
    }
    for (auto rank = first; rank != dropped; ++rank) is_kept[rank->pair] = true;
    first = last;
  }
  std::size_t end = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    if (is_kept[i]) pairs_[end++] = pairs_[i];
  pairs_.resize(end);
}

namespace {

auto PulseOf(const PulseReturn& a) { return std::tuple(a.time, a.channel, a.count); }

// Whether these returns of equal PulseOf and in order of their numbers can be those of one pulse.
bool IsOnePulse(const std::vector<PulseReturn>& returns) {
  if (returns.size() < 2 || returns.size() > returns[0].count) return false;
  return std::adjacent_find(returns.begin(), returns.end(), [](const PulseReturn& a, const PulseReturn& b) {
           return a.number == b.number;
         }) == returns.end();
}

}  // namespace

void PulseSample::Add(const PulseReturn& pulse_return) {
  if (HashOfTime(pulse_return.time) > limit_) return;
  returns_.push_back(pulse_return);
  if (returns_.size() >= 2 * most_) Thin();
}

void PulseSample::Thin() {
  while (returns_.size() > most_) {
    limit_ /= 2;
    std::erase_if(returns_, [this](const PulseReturn& a) { return HashOfTime(a.time) > limit_; });
    if (limit_ == 0) returns_.clear();  // All of one time.
  }
}

std::vector<std::vector<PulseReturn>> PulseSample::Take() {
  Thin();
  std::sort(returns_.begin(), returns_.end(), [](const PulseReturn& a, const PulseReturn& b) {
    return std::tuple(PulseOf(a), a.number) < std::tuple(PulseOf(b), b.number);
  });
  std::vector<std::vector<PulseReturn>> pulses;
  for (auto first = returns_.begin(); first != returns_.end();) {
    const auto last = std::find_if(first, returns_.end(),
                                   [&](const PulseReturn& other) { return PulseOf(other) != PulseOf(*first); });
    std::vector<PulseReturn> pulse(first, last);
    if (IsOnePulse(pulse)) pulses.push_back(std::move(pulse));
    first = last;
  }
  returns_ = {};
  return pulses;
}

}  // namespace albtpu
