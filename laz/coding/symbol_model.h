// The probability of each symbol of an alphabet, learned from the coded symbols: the adaptive models of A. Said,
// "Introduction to Arithmetic Coding - Theory and Practice", HP Laboratories HPL-2004-76, section 3.2, with the
// precision and the times of updates that the LASzip format prescribes (M. Isenburg, "LASzip: lossless compression of
// lidar data", Photogrammetric Engineering & Remote Sensing 79(2), 2013).
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace albtpu::laz {

inline constexpr int kProbabilityBits = 15;             // A probability of 1 is 1 << 15.
inline constexpr std::uint32_t kMaxCounted = 1u << 15;  // Then all counts are halved.

// Of at most `kMost` symbols. `kForDecoding` adds a table that finds the symbol of a cumulative probability.
// A model begins anew by Forget(); its arrays are filled when its first symbol is coded.
template <int kMost, bool kForDecoding>
class SymbolModel {
 public:
  explicit SymbolModel(int symbols = kMost) : symbols_(static_cast<std::uint32_t>(symbols)) {
    assert(symbols >= 2 && symbols <= kMost);
  }

  void Forget() { until_update_ = 0; }

  // Must be called before each use of the others.
  void Prepare() {
    if (until_update_ == 0) [[unlikely]]
      Start();
  }

  std::uint32_t last_symbol() const { return symbols_ - 1; }
  // The probability that a symbol is less than this one.
  std::uint32_t Below(std::uint32_t symbol) const { return shares_[symbol].below; }

  // The symbol in whose share of [0, 1 << kProbabilityBits) the number lies; numbers up to 63 above that range have the
  // last one.
  std::uint32_t SymbolAt(std::uint32_t number) const requires kForDecoding {
    std::uint32_t symbol = first_[number >> kSlotShift];
    // Bytes are often noise, whose symbols are about as likely as a slot is wide: no branch can be predicted.
    if constexpr (kMost == 256) symbol += shares_[symbol + 1].below <= number ? 1 : 0;
    while (shares_[symbol + 1].below <= number) ++symbol;
    return symbol;
  }

  void Count(std::uint32_t symbol) {
    ++shares_[symbol].count;
    if (--until_update_ == 0) [[unlikely]]
      Update();
  }

 private:
  static constexpr int kSlotBits = kMost <= 16 ? 6 : kMost <= 128 ? 7 : 8;
  static constexpr int kSlotShift = kProbabilityBits - kSlotBits;
  using Slot = std::conditional_t<kMost <= 256, std::uint8_t, std::uint16_t>;
  using Piece = std::array<Slot, 8 / sizeof(Slot)>;
  // One for numbers above the range, and room for a piece behind the last.
  static constexpr std::size_t kSlots = kForDecoding ? (std::size_t{1} << kSlotBits) + 1 + Piece().size() : 0;

  // All symbols are equally probable at first. Most models have kMost symbols and copy a common initial state.
  [[gnu::noinline]] void Start() {
    if (symbols_ < kMost) return StartCounting();
    static const SymbolModel fresh = [] {
      SymbolModel model;
      model.StartCounting();
      return model;
    }();
    *this = fresh;
  }

  void StartCounting() {
    for (std::uint32_t i = 0; i < symbols_; ++i) shares_[i].count = 1;
    total_ = 0;
    cycle_ = symbols_;
    Update();
    until_update_ = cycle_ = (symbols_ + 6) >> 1;
  }

  [[gnu::noinline]] void Update() {
    if ((total_ += cycle_) > kMaxCounted) {
      total_ = 0;
      for (std::uint32_t i = 0; i < symbols_; ++i)
        total_ += shares_[i].count = static_cast<std::uint16_t>((shares_[i].count + 1) >> 1);
    }
    const std::uint32_t scale = 0x80000000u / total_;
    std::uint32_t sum = 0;
    for (std::uint32_t i = 0; i < symbols_; ++i) {
      const std::uint32_t below = scale * sum >> (31 - kProbabilityBits);
      shares_[i].below = static_cast<std::uint16_t>(below);
      sum += shares_[i].count;
      if constexpr (kForDecoding) FillSlots(i, below, scale * sum >> (31 - kProbabilityBits));
    }
    shares_[symbols_].below = 0xFFFF;  // Above all arguments of SymbolAt().
    if constexpr (kForDecoding) first_[std::size_t{1} << kSlotBits] = static_cast<Slot>(last_symbol());
    cycle_ = std::min((5 * cycle_) >> 2, (symbols_ + 6) << 3);
    until_update_ = cycle_;
  }

  // States the first symbol of the numbers in each slot that begins in [below, end), in pieces: those behind `end` are
  // overwritten by the next symbol.
  void FillSlots(std::uint32_t symbol, std::uint32_t below, std::uint32_t end) {
    constexpr std::uint32_t kLastInSlot = (1u << kSlotShift) - 1;
    Piece piece;
    piece.fill(static_cast<Slot>(symbol));
    const Slot* const last = first_.data() + ((end + kLastInSlot) >> kSlotShift);
    Slot* slot = first_.data() + ((below + kLastInSlot) >> kSlotShift);
    do {
      std::memcpy(slot, piece.data(), sizeof piece);
      slot += piece.size();
    } while (slot < last);
  }

  std::uint32_t until_update_ = 0, cycle_ = 0, total_ = 0, symbols_;
  struct Share {
    std::uint16_t below, count;
  };
  std::array<Share, kMost + 1> shares_;
  std::array<Slot, kSlots> first_;
};

// The probability that a bit is 0.
class BitModel {
 public:
  static constexpr int kProbabilityBits = 13;

  void Forget() { *this = BitModel(); }
  std::uint32_t zero() const { return zero_; }
  void Count(bool bit) {
    zeros_ += !bit;
    if (--until_update_ == 0) Update();
  }

 private:
  static constexpr std::uint32_t kMaxCounted = 1u << 13, kLongestCycle = 64;

  void Update() {
    if ((total_ += cycle_) > kMaxCounted) {
      total_ = (total_ + 1) >> 1;
      zeros_ = (zeros_ + 1) >> 1;
      if (zeros_ == total_) ++total_;
    }
    zero_ = (zeros_ * (0x80000000u / total_)) >> (31 - kProbabilityBits);
    until_update_ = cycle_ = std::min((5 * cycle_) >> 2, kLongestCycle);
  }

  std::uint32_t zeros_ = 1, total_ = 2, cycle_ = 4, until_update_ = 4;
  std::uint32_t zero_ = 1u << (kProbabilityBits - 1);
};

}  // namespace albtpu::laz
