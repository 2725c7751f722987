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

  void Begin() {
    if (bytes_->empty()) bytes_->resize(kMinRoom);
    room_ = RoomBehind(0, *bytes_);
    base_ = 0;
    length_ = 0xFFFFFFFFu;
  }

  template <int kMost>
  [[gnu::always_inline]] std::uint32_t Symbol(SymbolModel<kMost, false>& model, std::uint32_t symbol) {
    model.Prepare();
    const std::uint32_t part = length_ >> kProbabilityBits;
    const std::uint32_t below = model.Below(symbol) * part;
    length_ = (symbol == model.last_symbol() ? length_ : model.Below(symbol + 1) * part) - below;
    Raise(below);
    model.Count(symbol);
    return symbol;
  }

  [[gnu::always_inline]] void Bit(BitModel& model, bool bit) {
    const std::uint32_t zero = model.zero() * (length_ >> BitModel::kProbabilityBits);
    length_ = bit ? length_ - zero : zero;
    Raise(bit ? zero : 0);
    model.Count(bit);
  }

  // `bits` < 2^count, count from 1 to 32.
  [[gnu::always_inline]] std::uint32_t Bits(int count, std::uint32_t bits) {
    int low_count = 0;
    if (count > 19) {
      low_count = 16;
      Raise((bits & 0xFFFF) * (length_ >>= low_count));
    }
    Raise((bits >> low_count) * (length_ >>= count - low_count));
    return bits;
  }

  std::uint64_t Bits64(std::uint64_t bits) {
    Bits(32, static_cast<std::uint32_t>(bits));
    Bits(32, static_cast<std::uint32_t>(bits >> 32));
    return bits;
  }

  // Ends the stream and gives its bytes: as many as a decoder reads, which is always 4 ahead.
  std::string Finish() {
    const bool short_end = length_ > 2 * kLeastLength;
    length_ = short_end ? kLeastLength >> 1 : kLeastLength >> 9;
    Raise(short_end ? kLeastLength : kLeastLength >> 1);
    return std::string(bytes_->data(), room_.next).append(short_end ? 3 : 2, '\0');
  }

 private:
  static constexpr std::uint32_t kLeastLength = 1u << 24;
  static constexpr std::size_t kMinRoom = 4096;  // Bytes.

  // Moves the begin of the interval, and then shifts bytes out of it until it is at least kLeastLength long.
  [[gnu::always_inline]] void Raise(std::uint32_t by) {
    base_ += by;
    if (base_ < by) Carry(room_.next);
    const std::uint32_t bytes = std::uint32_t{length_ < 1u << 24} + (length_ < 1u << 16) + (length_ < 1u << 8);
    const std::uint32_t first = __builtin_bswap32(base_);
    std::memcpy(room_.next, &first, sizeof first);  // The next ones overwrite those behind `bytes`.
    room_.next += bytes;
    base_ <<= 8 * bytes;
    length_ <<= 8 * bytes;
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
    return {bytes.data() + size, bytes.data() + bytes.size() - sizeof(std::uint32_t)};
  }

  std::uint32_t base_ = 0, length_ = 0xFFFFFFFFu;
  Room room_;
  std::unique_ptr<std::vector<char>> bytes_ = std::make_unique<std::vector<char>>();
};

}  // namespace albtpu::laz
