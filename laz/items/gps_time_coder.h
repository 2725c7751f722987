// GPS times, coded by their bit patterns as integers: the times of a flight line grow by multiples of about the same
// step. Up to four sequences of times interleave (several scanners, or lines that were merged).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "laz/coding/integer_coder.h"

namespace albtpu::laz {

// `kRepeats`: a time may be that of the point before (formats 1 to 5). The layers of formats 6 to 10 say elsewhere
// whether it is, and have no symbols for it.
template <typename Coder, bool kRepeats>
class GpsTimeCoder {
 public:
  // Begins anew after the first time.
  void Begin(std::int64_t first) {
    current_ = newest_ = 0;
    sequences_ = {};
    sequences_[0].time = static_cast<std::uint64_t>(first);
    starts_.Forget();
    multiples_.Forget();
    differences_.Forget();
  }

  // Decodes the next time, or encodes `time`; returns it.
  [[gnu::always_inline]] std::int64_t Code(Coder& coder, std::int64_t time) {
    // An encoder changes the sequence once at most; damaged bytes might do it forever.
    for (int changes = 0; changes < 4; ++changes) {
      Sequence& sequence = sequences_[current_];
      const std::uint64_t difference = static_cast<std::uint64_t>(time) - sequence.time;
      std::uint32_t other;
      if (sequence.step == 0) {
        other = coder.Symbol(starts_, Coder::kEncodes ? Start(difference) : 0);
        if (kRepeats && other == 0) return Time(sequence);
        if (other == kRepeats) {
          sequence.step = differences_.Code(coder, 0, static_cast<std::int32_t>(difference), 0);
          sequence.extremes = 0;
          return Advance(sequence, sequence.step);
        }
        other -= kRepeats + 1;
      } else {
        other = coder.Symbol(multiples_, Coder::kEncodes ? Multiple(difference, sequence.step) : 0);
        if (other < kMultiples) return Advance(sequence, CodeStep(coder, sequence, other, difference));
        other -= kMultiples;
        if (kRepeats && other == 0) return Time(sequence);
        other -= kRepeats;
      }
      if (other == 0) return StartSequence(coder, time);
      current_ = (current_ + other) % kSequences;
    }
    return Time(sequences_[current_]);
  }

 private:
  static constexpr std::uint32_t kSequences = 4;
  // Symbols of multiples_: the multiples 0 to 500 and -1 to -10 of the step; the same time, where it may be; a new
  // sequence; the next sequence but 0, 1, 2.
  static constexpr std::int32_t kLargest = 500, kSmallest = -10;
  static constexpr std::uint32_t kMultiples = kLargest - kSmallest + 1;
  // After as many multiples that are 0 or at the limits, the step is taken to have changed.
  static constexpr std::uint32_t kMostExtremes = 3;

  // Of a symbol of multiples_ that is a multiple.
  struct Multiplier {
    std::int16_t multiple;
    std::uint8_t context;  // Of differences_.
    bool extreme;          // The multiple is 0 or at a limit.
  };
  static constexpr Multiplier MultiplierOf(int symbol) {
    const int multiple = symbol <= kLargest ? symbol : kLargest - symbol;
    const bool extreme = multiple == 0 || multiple == kLargest || multiple == kSmallest;
    const int context = multiple == 1           ? 1
                        : multiple == 0         ? 7
                        : multiple == kSmallest ? 6
                        : multiple < 0          ? 5
                        : multiple == kLargest  ? 4
                        : multiple < 10         ? 2
                                                : 3;
    return {static_cast<std::int16_t>(multiple), static_cast<std::uint8_t>(context), extreme};
  }
  static constexpr std::array<Multiplier, kMultiples> kMultipliers = [] {
    std::array<Multiplier, kMultiples> multipliers{};
    for (std::size_t i = 0; i < kMultiples; ++i) multipliers[i] = MultiplierOf(static_cast<int>(i));
    return multipliers;
  }();

  struct Sequence {
    std::uint64_t time = 0;
    std::int32_t step = 0;
    std::uint32_t extremes = 0;
  };

  static std::int64_t Time(const Sequence& sequence) { return static_cast<std::int64_t>(sequence.time); }

  static std::int64_t Advance(Sequence& sequence, std::int32_t step) {
    sequence.time += static_cast<std::uint64_t>(std::int64_t{step});
    return Time(sequence);
  }

  static bool Fits(std::uint64_t difference) {
    return difference == static_cast<std::uint64_t>(std::int64_t{static_cast<std::int32_t>(difference)});
  }

  // The symbol of starts_ or, beyond kMultiples, of multiples_.
  std::uint32_t Start(std::uint64_t difference) const {
    if (kRepeats && difference == 0) return 0;
    return Fits(difference) ? kRepeats : kRepeats + 1 + Other(difference);
  }

  std::uint32_t Multiple(std::uint64_t difference, std::int32_t step) const {
    if (kRepeats && difference == 0) return kMultiples;
    if (!Fits(difference)) return kMultiples + kRepeats + Other(difference);
    const float quotient = static_cast<float>(static_cast<std::int32_t>(difference)) / static_cast<float>(step);
    const float limited = std::clamp(quotient, static_cast<float>(kSmallest), static_cast<float>(kLargest));
    const auto multiple = static_cast<std::int32_t>(limited + (limited >= 0 ? 0.5F : -0.5F));
    return static_cast<std::uint32_t>(multiple >= 0 ? multiple : kLargest - multiple);
  }

  // How many sequences further the time is near, or 0.
  std::uint32_t Other(std::uint64_t difference) const {
    const std::uint64_t time = sequences_[current_].time + difference;
    for (std::uint32_t i = 1; i < kSequences; ++i)
      if (Fits(time - sequences_[(current_ + i) % kSequences].time)) return i;
    return 0;
  }

  [[gnu::always_inline]] std::int32_t CodeStep(Coder& coder, Sequence& sequence, std::uint32_t symbol,
                                               std::uint64_t difference) {
    const Multiplier& multiplier = kMultipliers[symbol];
    const auto step_before = static_cast<std::uint32_t>(sequence.step);
    const std::uint32_t predicted = static_cast<std::uint32_t>(multiplier.multiple) * step_before;
    const std::int32_t step = differences_.Code(coder, static_cast<std::int32_t>(predicted),
                                                static_cast<std::int32_t>(difference), multiplier.context);
    sequence.extremes = multiplier.multiple == 1 ? 0 : sequence.extremes + (multiplier.extreme ? 1 : 0);
    if (sequence.extremes > kMostExtremes) [[unlikely]] {
      sequence.step = step;
      sequence.extremes = 0;
    }
    return step;
  }

  [[gnu::always_inline]] std::int64_t StartSequence(Coder& coder, std::int64_t time) {
    const auto upper = [](std::uint64_t bits) { return static_cast<std::int32_t>(bits >> 32); };
    const auto bits = static_cast<std::uint64_t>(time);
    const std::int32_t high = differences_.Code(coder, upper(sequences_[current_].time), upper(bits), 8);
    const std::uint32_t low = coder.Bits(32, static_cast<std::uint32_t>(bits));
    current_ = newest_ = (newest_ + 1) % kSequences;
    sequences_[current_] = {std::uint64_t{static_cast<std::uint32_t>(high)} << 32 | low, 0, 0};
    return Time(sequences_[current_]);
  }

  std::uint32_t current_ = 0, newest_ = 0;
  std::array<Sequence, kSequences> sequences_;
  typename Coder::template Model<kRepeats + 1 + kSequences> starts_;
  typename Coder::template Model<kMultiples + kRepeats + kSequences> multiples_;
  IntegerCoder<Coder, 32, 9> differences_;
};

}  // namespace albtpu::laz
