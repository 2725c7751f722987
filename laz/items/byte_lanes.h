// Eight layers of bytes that are coded at the same points, in the lanes of vectors: their models, and their encoder.
// They give the bytes that an ArithmeticEncoder and a SymbolModel<256> of each layer would give.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "laz/coding/arithmetic_encoder.h"

namespace albtpu::laz {

inline constexpr std::size_t kByteLanes = 8;

// The models of all lanes, which are updated at the same points.
class ByteLaneModels {
 public:
  static constexpr std::uint32_t kSymbols = 256;
  template <typename Number>
  using Lanes = std::array<Number, kByteLanes>;

  // By symbol; of each, all lanes.
  struct Tables {
    // From the lowest bit on: the probability that a symbol is less than this one, the probability of this one, and
    // kIsLast. Both have 15 bits.
    alignas(64) std::array<std::uint32_t, kSymbols * kByteLanes> shares;
    alignas(64) std::array<std::uint16_t, kSymbols * kByteLanes> counts;
    alignas(64) Lanes<std::uint32_t> totals;  // Of the counts, before the last update.
  };
  static constexpr std::uint32_t kShareMask = (1u << kProbabilityBits) - 1;
  static constexpr std::uint32_t kIsLast = 1u << 31;  // It has the rest of the interval.

  // A model begins anew by Forget(), and with its next point.
  void Forget() { until_update_ = 0; }
  // Must be called before each use of the others.
  void Prepare() {
    if (until_update_ == 0) Start();
  }

  Tables& tables() { return tables_; }
  // The points that are coded by these tables.
  std::uint32_t until_update() const { return until_update_; }
  // After so many of them, whose symbols were counted.
  void Pass(std::uint32_t points);

 private:
  void Start();

  Tables tables_;
  std::uint32_t cycle_ = 0, until_update_ = 0;
};

// The bytes of records that are coded in lanes. They lie near to each other, in a window.
struct LaneWindow {
  static constexpr std::size_t kSize = 16;
  static constexpr std::uint8_t kIdle = 0x80;

  std::size_t offset = 0;                        // Of the window in a record, which has the whole window.
  std::array<std::uint8_t, kSize> places = [] {  // Of the byte of each lane in the window, or kIdle: it codes zeros.
    std::array<std::uint8_t, kSize> idle;
    idle.fill(kIdle);
    return idle;
  }();

  std::uint8_t Byte(std::size_t lane, const char* window) const {
    return places[lane] == kIdle ? std::uint8_t{0} : static_cast<std::uint8_t>(window[places[lane]]);
  }
};

// Records, each byte of which is coded as its difference from that of the record before.
struct ByteLaneRun {
  const char* first = nullptr;
  std::size_t record_length = 0;
  std::uint32_t count = 0;       // At most until_update().
  const char* before = nullptr;  // The window of the record before the first.

  const char* record(std::size_t i) const { return first + i * record_length; }
};

// The intervals of the encoders during a run.
struct LaneIntervals {
  template <typename Number>
  using Lanes = ByteLaneModels::Lanes<Number>;
  static constexpr std::size_t kMostBytes = 2;  // That a symbol may give.

  alignas(64) Lanes<std::uint32_t> length;
  alignas(64) Lanes<std::uint64_t> begin;  // As in ArithmeticEncoder::Interval.
  alignas(64) Lanes<std::uint64_t> next;   // Addresses.
  // The upper half is all ones if that of `begin` ever was: a carry might have gone further.
  alignas(64) Lanes<std::uint64_t> reach;
};

// Codes the run, and counts it in the models.
void EncodeByteLanes(const LaneWindow& window, const ByteLaneRun& run, ByteLaneModels& models,
                     const std::array<ArithmeticEncoder*, kByteLanes>& encoders);

}  // namespace albtpu::laz
