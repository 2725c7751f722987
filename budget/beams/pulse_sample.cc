#include "budget/beams/pulse_sample.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>
#include <utility>

#include "sea/samples.h"

namespace albtpu {
std::uint64_t HashOfTime(double time) { return MixBits(std::bit_cast<std::uint64_t>(time) + 0x9e3779b97f4a7c15); }

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
  // Sorted in place of the pairs, which are three times as long.
  struct Rank {
    double bin;
    std::uint64_t hash;
    std::size_t pair;
  };
  const auto order = [this](const Rank& rank) {
    const ReturnPair& pair = pairs_[rank.pair];
    return std::tuple(rank.bin, rank.hash, pair.lower.z(), pair.upper.z());
  };
  std::vector<Rank> ranks(pairs_.size());
  std::vector<bool> is_kept(pairs_.size());
  while (true) {
    for (std::size_t i = 0; i < ranks.size(); ++i)
      ranks[i] = {std::floor(pairs_[i].time / size_.bin), HashOfTime(pairs_[i].time), i};
    std::sort(ranks.begin(), ranks.end(), [&](const Rank& a, const Rank& b) { return order(a) < order(b); });
    is_kept.assign(pairs_.size(), false);
    std::size_t kept = 0, in_bin = 0;
    for (std::size_t i = 0; i < ranks.size(); ++i) {
      in_bin = i > 0 && ranks[i].bin == ranks[i - 1].bin ? in_bin + 1 : 0;
      if (in_bin >= size_.pairs_per_bin) continue;
      is_kept[ranks[i].pair] = true;
      ++kept;
    }
    if (kept <= most) break;
    if (size_.pairs_per_bin > 1)
      size_.pairs_per_bin = (size_.pairs_per_bin + 1) / 2;
    else
      size_.bin *= 2;
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
