// The arithmetic encoder of LASzip files (A. Said, HPL-2004-76, section 2.2; an interval of 32 bits
// that is renormalized bytewise).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "laz/coding/symbol_model.h"

namespace albtpu::laz {

// Hot loops move the encoder into a local variable, as they do with a decoder.
class ArithmeticEncoder {
 public:
  static constexpr bool kEncodes = true;
  template <int kMost>
  using Model = SymbolModel<kMost, false>;

  // The interval of what was coded so far, for loops that work on some encoders at a time.
  struct Interval {
    // Where it begins: the 32 bits that are still open, and above them the last four bytes that were written, so that
    // a carry reaches these without a look at the memory.
    std::uint64_t begin = 0;
    std::uint32_t length = 0xFFFFFFFFu;
  };
  static constexpr std::uint32_t kLeastLength = 1u << 24;
  // The written bytes that `begin` has, and the bytes behind them that each step writes ahead.
  static constexpr std::size_t kOpenBytes = 4;

  void Begin() {
    if (bytes_->empty()) bytes_->resize(kMinRoom);
    interval_ = Interval();
    room_ = RoomBehind(kOpenBytes, *bytes_);  // No carry leads to those before.
  }

  const Interval& interval() const { return interval_; }
  // The place of the next byte, where so many more have room.
  char* Reserve(std::size_t count) {
    while (room_.next + count > room_.last) room_ = Grow(room_.next, *bytes_);
    return room_.next;
  }
  // Once the bytes before `next` are written.
  void Continue(const Interval& interval, char* next) {
    interval_ = interval;
    room_.next = next;
  }

  template <int kMost>
  [[gnu::always_inline]] std::uint32_t Symbol(SymbolModel<kMost, false>& model, std::uint32_t symbol) {
    model.Prepare();
    const std::uint32_t part = interval_.length >> kProbabilityBits;
    const std::uint32_t below = model.Below(symbol) * part;
    interval_.length = (symbol == model.last_symbol() ? interval_.length : model.Below(symbol + 1) * part) - below;
    Raise(below);
    model.Count(symbol);
    return symbol;
  }

  [[gnu::always_inline]] void Bit(BitModel& model, bool bit) {
    const std::uint32_t zero = model.zero() * (interval_.length >> BitModel::kProbabilityBits);
    interval_.length = bit ? interval_.length - zero : zero;
    Raise(bit ? zero : 0);
    model.Count(bit);
  }

  // `bits` < 2^count, count from 1 to 32.
  [[gnu::always_inline]] std::uint32_t Bits(int count, std::uint32_t bits) {
    int low_count = 0;
    if (count > 19) {
      low_count = 16;
      Raise((bits & 0xFFFF) * (interval_.length >>= low_count));
    }
    Raise((bits >> low_count) * (interval_.length >>= count - low_count));
    return bits;
  }

  std::uint64_t Bits64(std::uint64_t bits) {
    Bits(32, static_cast<std::uint32_t>(bits));
    Bits(32, static_cast<std::uint32_t>(bits >> 32));
    return bits;
  }

  // Takes the part of the interval that begins `by` behind its begin and has this length, which is not 0.
  [[gnu::always_inline]] void Narrow(std::uint32_t by, std::uint32_t length) {
    interval_.length = length;
    Raise(by);
  }

  // Ends the stream and appends its bytes to others: as many as a decoder reads, which is always 4 ahead.
  void Finish(std::string& bytes) {
    const bool short_end = interval_.length > 2 * kLeastLength;
    interval_.length = short_end ? kLeastLength >> 1 : kLeastLength >> 9;
    Raise(short_end ? kLeastLength : kLeastLength >> 1);
    const char* const begin = bytes_->data() + kOpenBytes;
    bytes.append(begin, static_cast<std::size_t>(room_.next - begin));
    bytes.append(short_end ? 3 : 2, '\0');
  }
  std::string Finish() {
    std::string bytes;
    Finish(bytes);
    return bytes;
  }

 private:
  static constexpr std::size_t kMinRoom = 4096;  // Bytes.

  // Moves the begin of the interval, and then shifts bytes out of it until it is at least kLeastLength long.
  [[gnu::always_inline]] void Raise(std::uint32_t by) {
    interval_.begin += by;
    if (interval_.begin < by) [[unlikely]]
      Carry(room_.next - kOpenBytes);
    const std::uint64_t bytes = __builtin_bswap64(interval_.begin);
    std::memcpy(room_.next - kOpenBytes, &bytes, sizeof bytes);  // The next ones overwrite the open bits.
    const int bits = __builtin_clz(interval_.length) & 24;
    interval_.begin <<= bits;
    interval_.length <<= bits;
    room_.next += bits / 8;
    if (room_.next > room_.last) [[unlikely]]
      room_ = Grow(room_.next, *bytes_);
  }

  // The place of the next bytes. Four have room as long as `next` is not behind `last`.
  struct Room {
    char *next = nullptr, *last = nullptr;
  };

  [[gnu::noinline]] static void Carry(char* next) {
    char* byte = next - 1;
    while (*byte == '\xFF') *byte-- = 0;
    ++*byte;
  }

  [[gnu::noinline]] static Room Grow(const char* next, std::vector<char>& bytes) {
    const auto size = static_cast<std::size_t>(next - bytes.data());
    bytes.resize(2 * bytes.size());
    return RoomBehind(size, bytes);
  }

  static Room RoomBehind(std::size_t size, std::vector<char>& bytes) {
    return {bytes.data() + size, bytes.data() + bytes.size() - kOpenBytes};
  }

  Interval interval_;
  Room room_;
  std::unique_ptr<std::vector<char>> bytes_ = std::make_unique<std::vector<char>>();
};

}  // namespace albtpu::laz
