#include "annotate/beams/pulse_sample.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "annotate/beams/pair_sample.h"

namespace albtpu::annotate {
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
    const auto last = std::find_if(
        first, returns_.end(), [&](const PulseReturn& other) { return PulseOf(other) != PulseOf(*first); });
    std::vector<PulseReturn> pulse(first, last);
    if (IsOnePulse(pulse)) pulses.push_back(std::move(pulse));
    first = last;
  }
  returns_ = {};
  return pulses;
}

}  // namespace albtpu::annotate
